/*! uPlot 1.6.32:
The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.*/
"use strict";(()=>{function Le(t){return Float64Array.from(t)}function Ie(t,e){let n=new Float64Array(16);for(let r=0;r<16;r+=4)for(let s=0;s<4;++s)n[r+s]=t[r]*e[s]+t[r+1]*e[4+s]+t[r+2]*e[8+s]+t[r+3]*e[12+s];return n}function st(t,e=0){let[n,r,s]=[t[e],t[e+1],t[e+2]],i=Math.hypot(t[e+3],t[e+4],t[e+5],t[e+6])||1,[o,a,l,u]=[3,4,5,6].map(d=>t[e+d]/i);return Le([1-2*(l*l+u*u),2*(a*l-o*u),2*(a*u+o*l),n,2*(a*l+o*u),1-2*(a*a+u*u),2*(l*u-o*a),r,2*(a*u-o*l),2*(l*u+o*a),1-2*(a*a+l*l),s,0,0,0,1])}function Co(t){let n=[[1,1,1],[1,-1,-1],[-1,1,-1],[-1,-1,1]].map(([d,h,p])=>Math.max(0,1+d*t[0]+h*t[5]+p*t[10])),[r,s,i,o]=n.map(d=>Math.sqrt(d)/2),a=n.indexOf(Math.max(...n)),l=[[1,t[9]-t[6],t[2]-t[8],t[4]-t[1]],[t[9]-t[6],1,t[1]+t[4],t[2]+t[8]],[t[2]-t[8],t[1]+t[4],1,t[6]+t[9]],[t[4]-t[1],t[2]+t[8],t[6]+t[9],1]],u=[r,s,i,o].map((d,h)=>d*(l[a][h]<0?-1:1));return[t[3],t[7],t[11],...u]}function ut(t){let e=n=>-(t[n]*t[3]+t[4+n]*t[7]+t[8+n]*t[11]);return Le([t[0],t[4],t[8],e(0),t[1],t[5],t[9],e(1),t[2],t[6],t[10],e(2),0,0,0,1])}function ei(t){return me([t[0],t[1],t[2]],nt([t[4],t[5],t[6]],[t[8],t[9],t[10]]))}function Oo(t){let e=[0,4,8].map(o=>[t[o],t[o+1],t[o+2]]),n=1/ei(t),[r,s,i]=[nt(e[1],e[2]),nt(e[2],e[0]),nt(e[0],e[1])];return Le([...[r,s,i].flatMap(o=>[o[0]*n,o[1]*n,o[2]*n,0]),0,0,0,1])}function Pe(t,e){return[t[0]*e[0]+t[1]*e[1]+t[2]*e[2]+t[3],t[4]*e[0]+t[5]*e[1]+t[6]*e[2]+t[7],t[8]*e[0]+t[9]*e[1]+t[10]*e[2]+t[11]]}function Fn(t,e){return[me([t[0],t[1],t[2]],e),me([t[4],t[5],t[6]],e),me([t[8],t[9],t[10]],e)]}function Cn(t,e){return[me([t[0],t[4],t[8]],e),me([t[1],t[5],t[9]],e),me([t[2],t[6],t[10]],e)]}function Re(t){return[t[3],t[7],t[11]]}function me(t,e){return t[0]*e[0]+t[1]*e[1]+t[2]*e[2]}function nt(t,e){return[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]]}function Me(t,e,n=1){return[t[0]+n*e[0],t[1]+n*e[1],t[2]+n*e[2]]}function _t(t){let e=Math.hypot(t[0],t[1],t[2])||1;return[t[0]/e,t[1]/e,t[2]/e]}function ti(t,e,n=[0,0,1]){let r=_t(Me(t,e,-1)),s=nt(n,r);Math.hypot(...s)<1e-6&&(s=nt([1,0,0],r)),s=_t(s);let i=nt(r,s);return Le([s[0],i[0],r[0],t[0],s[1],i[1],r[1],t[1],s[2],i[2],r[2],t[2],0,0,0,1])}function No(t,e,n){let r=Math.min(e,.75*t)/(2*Math.tan(n/2)),s={cx:(t-1)/2,cy:(e-1)/2};return{width:t,height:e,fx:r,fy:r,...s,skew:0,near:.05,far:2e3}}function an(t,e){let[n,r]=[Math.round(t.width*e),Math.round(t.height*e)];return{...t,width:n,height:r,fx:t.fx*e,fy:t.fy*e,cx:(t.cx+.5)*e-.5,cy:(t.cy+.5)*e-.5,skew:t.skew*e}}function Hr(t,e){let{width:n,height:r,near:s,far:i}=t,o=i-s,a=e?1:-1;return Le([2*t.fx/n,2*t.skew/n,1-(2*t.cx+1)/n,0,0,-2*a*t.fy/r,a*(1-(2*t.cy+1)/r),0,0,0,-(i+s)/o,-2*i*s/o,0,0,-1,0])}function zt(t){return[0,1,2,3].flatMap(e=>[t[e],t[4+e],t[8+e],t[12+e]])}var ri=class{constructor(e,n){this.head=e;this.data=n}head;data;numbers(e){let[n,r,s]=e;switch(s){case"f4":return new Float32Array(this.data,n,r);case"u4":return new Uint32Array(this.data,n,r);case"u2":return new Uint16Array(this.data,n,r);case"i2":return new Int16Array(this.data,n,r);case"i1":return new Int8Array(this.data,n,r);default:return new Uint8Array(this.data,n,r)}}};async function Uo(t){let e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return new Response(e).arrayBuffer()}var Do="0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";function Ho(t){let e=new Uint8Array(128);for(let s=0;s<Do.length;++s)e[Do.charCodeAt(s)]=s;let n=Math.ceil(t.length/5),r=new DataView(new ArrayBuffer(4*n));for(let s=0;s<n;++s){let i=0;for(let o=5*s;o<5*s+5;++o)i=85*i+(o<t.length?e[t.charCodeAt(o)]:84);r.setUint32(4*s,i)}return new Uint8Array(r.buffer,0,t.length-n)}async function ln(t){let e=await Uo(t),n=new DataView(e).getUint32(0,!0),r=JSON.parse(new TextDecoder().decode(new Uint8Array(e,4,n)));return new ri(r,e.slice(4+n))}var ni=class{constructor(e,n,r=[]){this.head=e;this.rows=n;this.removals=r}head;rows;removals;get columns(){return 7*this.head.bodies.length+this.head.signals.length}get end(){return this.head.start+Math.max(0,this.head.n-1)/this.head.rate}rowIndex(e){return Math.floor(this.rowPosition(e)+1e-6)}rowPosition(e){return Math.min(Math.max((e-this.head.start)*this.head.rate,0),this.head.n-1)}row(e){let n=this.columns,r=this.rowIndex(e),s=this.rows.slice(r*n,(r+1)*n),i=this.rowPosition(e)-r;if(i<1e-6||r+1>=this.head.n)return s;let o=(r+1)*n;for(let a=0;a<7*this.head.bodies.length;++a)s[a]+=i*(this.rows[o+a]-s[a]);return s}};async function Vo(t){let e=new Uint8Array(await Uo(t)),n=e.indexOf(10),r=JSON.parse(new TextDecoder().decode(e.subarray(0,n))),s=r.n,i=7*r.bodies.length+r.signals.length,o=e.subarray(n+1),a=Bo(o,s,i,l=>{let u=l%7<3?r.length:r.quaternion;return l<7*r.bodies.length?u:r.signals[l-7*r.bodies.length].step});return new ni(r,a,Du(r,o.subarray(4*s*i)))}function Bo(t,e,n,r){let s=new Float64Array(e*n);for(let i=0;i<n;++i){let o=r(i),a=0;for(let l=0,u=i*e;l<e;++l,++u){let d=t[u]|t[e*n+u]<<8|t[2*e*n+u]<<16;a=a+(d|t[3*e*n+u]<<24)|0,s[l*n+i]=a===-2147483648?NaN:a*o}}return s}function Du({sand:t},e){if(!t)return[];let n=Bo(e,t.n,5,r=>r<2?1:t.grain);return Array.from({length:t.n},(r,s)=>{let[i,o,a,l,u]=n.subarray(5*s,5*s+5);return{row:i,heap:o,position:Number.isNaN(a)?null:[a,l,u]}})}function N(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no element ${t}`);return e}function j(t,e="",n=""){let r=document.createElement(t);return r.textContent=e,r.className=n,r}function si(t){return t==="ok"?"ok":t==="lost"||t.includes("error")?"bad":"other"}function hr(t,e){let n=-1;return t.levels.forEach(({trial:r,level:s},i)=>{r===t.trial&&s.start<=e+1e-6&&(n=i)}),n}function Go(t){let e=t.levels.filter(({trial:n})=>n===t.trial);return e.length>0&&e.every(({level:n})=>n.status==="no motion")}var On=class{constructor(e,n){this.player=e;this.choose=n}player;choose;list=N("levels");current=-2;lastLevel=null;show(e){this.lastLevel!==this.player.levels.at(-1)?.level&&this.fill();let n=hr(this.player,e);if(n===this.current)return;this.current=n,this.list.querySelectorAll("button").forEach((i,o)=>{if(i.setAttribute("aria-current",String(o===n)),o!==n||this.list.contains(document.activeElement))return;let a=i.offsetTop-this.list.offsetTop;(a<this.list.scrollTop||a>this.list.scrollTop+this.list.clientHeight-24)&&(this.list.scrollTop=a-this.list.clientHeight/2)});let r=this.player.levels[n]?.level,s=N("now");s.textContent=r?`${r.label} · ${r.status}`:"",s.className=`badge ${r?si(r.status):""}`,N("why").textContent=r?.why??"",N("why").title=r?.why??""}mark(e,n){let r=N("marks");r.replaceChildren();let s=i=>`${100*(i-e)/Math.max(n-e,1e-9)}%`;for(let{trial:i,level:o}of this.player.levels){if(i!==this.player.trial)continue;let a=j("i","",si(o.status));a.style.left=s(o.start),a.style.width=s(e+o.end-o.start),a.title=`${o.label}: ${o.status}`,r.append(a)}}fill(){this.lastLevel=this.player.levels.at(-1)?.level,this.current=-2,N("levels-box").hidden=!this.lastLevel,this.list.replaceChildren(...this.player.levels.map(({level:e},n)=>{let r=j("button");r.append(j("span",e.label),j("span",e.status,si(e.status))),r.title=e.why??"",r.addEventListener("click",()=>this.choose(n));let s=j("li");return s.append(r),s}))}},Nn=class{bars=[];constructor(e){let n=N("thrusters");for(let r of e.vehicles)for(let s of r.thrusters){let i=j("div"),[o,a,l]=[j("span","","bar"),j("i"),j("output")];o.append(a);let u=e.vehicles.length>1?`${r.name} ${s}`:s;i.append(j("span",u.replaceAll("_"," ")),o,l),n.append(i),this.bars.push({signal:`thrust/${r.name}/${s}`,bar:a,value:l})}}show(e){let n=!1;for(let{signal:r,bar:s,value:i}of this.bars){let o=e.signal(r);if(o===void 0)continue;n=!0;let a=50*Math.min(1,Math.abs(o));s.style.left=`${o<0?50-a:50}%`,s.style.width=`${a}%`,i.textContent=`${Math.round(100*o)||0} %`}N("thrusters-box").hidden=!n}};function Wo(t){let e=N("help");e.replaceChildren();let[n,r]=[j("div","","rows"),j("div","","columns")];n.tabIndex=0,n.append(r),e.append(n);for(let[i,o]of Object.entries(t)){let a=j("dl");for(let u of o)a.append(j("dt",u.keys),j("dd",u.action));let l=j("section");l.append(j("h2",i),a),r.append(l)}let s=j("button","Close");s.addEventListener("click",()=>e.close()),e.append(s)}function Dn(){let t=N("help");t.open?t.close():t.showModal()}var Uu=100,Hu=33,Vu=["left","right"],zo={surge:["forward","back"],sway:["right","left"],heave:["up","down"],yaw:["turn right","left"],roll:["roll right","left"],pitch:["pitch up","down"],lamps:["lamps brighter","darker"]},Bu={yaw:"turn",sway:"left / right"},Gu=6e3,Un=class{constructor(e){this.send=e;document.addEventListener("keyup",n=>{this.pressedKeys.delete(n.key.toLowerCase()),this.poll()}),window.addEventListener("blur",()=>{this.pressedKeys.clear(),this.poll()}),setInterval(()=>this.poll(),Hu)}send;isOn=!1;mapping={};reason="";names={};reservedKeys=new Set;layout="";pressedKeys=new Set;sticks=[0,0,0,0];lastText="";sendTime=0;enable(e){this.isOn=e.pilot,this.mapping=e.pilot?e.mapping:{},this.reservedKeys=new Set(e.reserved),[this.names,this.reason]=[e.names,e.why];let n=JSON.stringify([e.pilot,e.sticks,e.names,e.why]);if(n===this.layout)return;this.layout=n;let s=[...Vu.map((i,o)=>this.stick(i,2*o,e.sticks.slice(2*o,2*o+2))).filter(i=>i!==null),this.reason?j("p",this.reason,"why"):this.keyHints()];N("pilot").replaceChildren(...s.filter(i=>i!==null)),N("pilot").hidden=!e.pilot}isReserved(e){return this.isOn&&this.reservedKeys.has(e)}handlePilotKey(e){let n=e.key.toLowerCase();return e.shiftKey||!this.isReserved(n)?!1:(e.preventDefault(),n in this.mapping&&(this.pressedKeys.add(n),this.poll(),this.hideKeyHints()),!0)}help(){let e=this.keyPairs();return e.length?[...e.map(({axes:r,plusKeys:s,minusKeys:i})=>({keys:`${s||"–"}  ${i||"–"}`,action:`${this.namesOf(r)} +, −`})),{keys:"Shift",action:"with a letter: the page's own key"}]:[{keys:"–",action:this.reason||"this simulation has no pilot"}]}keyPairs(){let e=new Map;for(let[n,r]of Object.entries(this.mapping)){if(!r.trim())continue;let[s,i]=jo(r),o=e.get(s)??["",""];o[i]+=(o[i]&&", ")+n,e.set(s,o)}return[...e].map(([n,[r,s]])=>({axes:n,plusKeys:r,minusKeys:s}))}namesOf(e){return e.split(" ").map(n=>{let r=this.names[n.replace("-","")];return r?n.replace(/[a-z]+\d*/,r):n}).join(" ")}keyHints(){let e=this.keyPairs();if(!e.length)return null;let n=j("div","","keyline");for(let{axes:i,plusKeys:o,minusKeys:a}of e){let l=j("span"),u=zo[i]?.join(" / ")??this.namesOf(i);for(let d of[o,a])d&&l.append(j("kbd",d.toUpperCase()));l.append(` ${u}`),n.append(l)}let r=j("span");r.append(j("kbd","?")," all keys");let s=j("button","×");return s.setAttribute("aria-label","Hide the line of keys"),s.addEventListener("click",()=>n.remove()),n.append(r,s),n}hideKeyHints(){let e=N("pilot").querySelector(".keyline");e&&!e.classList.contains("leaves")&&(e.classList.add("leaves"),setTimeout(()=>e.remove(),Gu))}input(){let e=navigator.getGamepads?.().find(n=>n!==null);return{keys:[...this.pressedKeys].sort(),axes:e?e.axes.map(ii):[],buttons:e?e.buttons.map(({value:n})=>ii(n)):[],sticks:this.sticks.map(ii)}}poll(){if(!this.isOn)return;let e=this.input(),n=JSON.stringify(e),r=performance.now(),s=!e.keys.length&&![...e.axes,...e.buttons,...e.sticks].some(Boolean);if(n===this.lastText&&(s||r-this.sendTime<Uu))return;let i=n!==this.lastText;this.lastText=n,this.sendTime=r,this.send({type:"input",...e},i)}stick(e,n,r){if(!r.some(h=>h.trim()))return null;let[s,i]=[j("div","",`thumb ${e}`),j("div","","label")],o=["↔","↕"];r.forEach((h,p)=>{h.trim()&&i.prepend(j("span",`${o[p]} ${this.stickWords(h)}`))});let[a,l]=[j("div","","stick"),j("i")];a.title=i.innerText,a.append(l),s.append(i,a);let u=(h,p)=>{let b=Math.max(1,Math.hypot(h,p));this.sticks[n]=h/b,this.sticks[n+1]=p/b,l.style.transform=`translate(${35*h/b}px, ${-35*p/b}px)`,this.poll()},d=h=>{if(!a.hasPointerCapture(h.pointerId))return;let p=a.getBoundingClientRect(),b=p.width/2;u((h.clientX-p.left-b)/b,-(h.clientY-p.top-b)/b)};a.addEventListener("pointerdown",h=>{a.setPointerCapture(h.pointerId),d(h)}),a.addEventListener("pointermove",d);for(let h of["pointerup","pointercancel"])a.addEventListener(h,()=>u(0,0));return s}stickWords(e){let[n]=jo(e);return Bu[n]??zo[n]?.join(" / ")??this.namesOf(n)}};function jo(t){let e=t.trim().split(/\s+/),n=e[0].startsWith("-");return[e.map(s=>(s.startsWith("-")!==n?"-":"")+s.replace(/^[+-]+/,"")).join(" "),n?1:0]}function ii(t){return Math.round(t*1e3)/1e3}var Wu="uplot",zu="u-hz",ju="u-vt",Yu="u-title",qu="u-wrap",Xu="u-under",$u="u-over",Ku="u-axis",pr="u-off",Qu="u-select",Ju="u-cursor-x",Zu="u-cursor-y",ef="u-cursor-pt",tf="u-legend",rf="u-live",nf="u-inline",sf="u-series",of="u-marker",Yo="u-label",af="u-value",un="width",fn="height";var qo="bottom",Vr="left",oi="right",Ei="#000",Xo=Ei+"0",ai="mousemove",$o="mousedown",li="mouseup",Ko="mouseenter",Qo="mouseleave",Jo="dblclick",lf="resize",cf="scroll",Zo="change",Wn="dppxchange",Mi="--",qr=typeof window<"u",mi=qr?document:null,Gr=qr?window:null,uf=qr?navigator:null,ae,Hn;function di(){let t=devicePixelRatio;ae!=t&&(ae=t,Hn&&gi(Zo,Hn,di),Hn=matchMedia(`(min-resolution: ${ae-.001}dppx) and (max-resolution: ${ae+.001}dppx)`),gr(Zo,Hn,di),Gr.dispatchEvent(new CustomEvent(Wn)))}function ft(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function pi(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function _e(t,e,n){t.style[e]=n+"px"}function Lt(t,e,n,r){let s=mi.createElement(t);return e!=null&&ft(s,e),n?.insertBefore(s,r),s}function wt(t,e){return Lt("div",t,e)}var ea=new WeakMap;function Vt(t,e,n,r,s){let i="translate("+e+"px,"+n+"px)",o=ea.get(t);i!=o&&(t.style.transform=i,ea.set(t,i),e<0||n<0||e>r||n>s?ft(t,pr):pi(t,pr))}var ta=new WeakMap;function ra(t,e,n){let r=e+n,s=ta.get(t);r!=s&&(ta.set(t,r),t.style.background=e,t.style.borderColor=n)}var na=new WeakMap;function sa(t,e,n,r){let s=e+""+n,i=na.get(t);s!=i&&(na.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=r?-e/2+"px":0,t.style.marginTop=r?-n/2+"px":0)}var Si={passive:!0},ff={...Si,capture:!0};function gr(t,e,n,r){e.addEventListener(t,n,r?ff:Si)}function gi(t,e,n,r){e.removeEventListener(t,n,Si)}qr&&di();function Pt(t,e,n,r){let s;n=n||0,r=r||e.length-1;let i=r<=2147483647;for(;r-n>1;)s=i?n+r>>1:ht((n+r)/2),e[s]<t?n=s:r=s;return t-e[n]<=e[r]-t?n:r}function Ia(t){return(n,r,s)=>{let i=-1,o=-1;for(let a=r;a<=s;a++)if(t(n[a])){i=a;break}for(let a=s;a>=r;a--)if(t(n[a])){o=a;break}return[i,o]}}var Fa=t=>t!=null,Ca=t=>t!=null&&t>0,Yn=Ia(Fa),hf=Ia(Ca);function mf(t,e,n,r=0,s=!1){let i=s?hf:Yn,o=s?Ca:Fa;[e,n]=i(t,e,n);let a=t[e],l=t[e];if(e>-1)if(r==1)a=t[e],l=t[n];else if(r==-1)a=t[n],l=t[e];else for(let u=e;u<=n;u++){let d=t[u];o(d)&&(d<a?a=d:d>l&&(l=d))}return[a??de,l??-de]}function qn(t,e,n,r){let s=aa(t),i=aa(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let o=n==10?jt:Oa,a=s==1?ht:xt,l=i==1?xt:ht,u=a(o(De(t))),d=l(o(De(e))),h=Wr(n,u),p=Wr(n,d);return n==10&&(u<0&&(h=pe(h,-u)),d<0&&(p=pe(p,-d))),r||n==2?(t=h*s,e=p*i):(t=Ha(t,h),e=Xn(e,p)),[t,e]}function Ai(t,e,n,r){let s=qn(t,e,n,r);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ti=.1,ia={mode:3,pad:Ti},mn={pad:0,soft:null,mode:0},df={min:mn,max:mn};function zn(t,e,n,r){return $n(n)?oa(t,e,n):(mn.pad=n,mn.soft=r?0:null,mn.mode=r?3:0,oa(t,e,df))}function ie(t,e){return t??e}function pf(t,e,n){for(e=ie(e,0),n=ie(n,t.length-1);e<=n;){if(t[e]!=null)return!0;e++}return!1}function oa(t,e,n){let r=n.min,s=n.max,i=ie(r.pad,0),o=ie(s.pad,0),a=ie(r.hard,-de),l=ie(s.hard,de),u=ie(r.soft,de),d=ie(s.soft,-de),h=ie(r.mode,0),p=ie(s.mode,0),b=e-t,_=jt(b),w=Ze(De(t),De(e)),S=jt(w),T=De(S-_);(b<1e-24||T>10)&&(b=0,(t==0||e==0)&&(b=1e-24,h==2&&u!=de&&(i=0),p==2&&d!=-de&&(o=0)));let x=b||w||1e3,A=jt(x),M=Wr(10,ht(A)),z=x*(b==0?t==0?.1:1:i),k=pe(Ha(t-z,M/10),24),U=t>=u&&(h==1||h==3&&k<=u||h==2&&k>=u)?u:de,V=Ze(a,k<U&&t>=U?U:kt(U,k)),X=x*(b==0?e==0?.1:1:o),Y=pe(Xn(e+X,M/10),24),P=e<=d&&(p==1||p==3&&Y>=d||p==2&&Y<=d)?d:-de,K=kt(l,Y>P&&e<=P?P:Ze(P,Y));return V==K&&V==0&&(K=100),[V,K]}var gf=new Intl.NumberFormat(qr?uf.language:"en-US"),Ri=t=>gf.format(t),mt=Math,Gn=mt.PI,De=mt.abs,ht=mt.floor,Ne=mt.round,xt=mt.ceil,kt=mt.min,Ze=mt.max,Wr=mt.pow,aa=mt.sign,jt=mt.log10,Oa=mt.log2,vf=(t,e=1)=>mt.sinh(t)*e,ci=(t,e=1)=>mt.asinh(t/e),de=1/0;function la(t){return(jt((t^t>>31)-(t>>31))|0)+1}function vi(t,e,n){return kt(Ze(t,e),n)}function Na(t){return typeof t=="function"}function re(t){return Na(t)?t:()=>t}var bf=()=>{},Da=t=>t,Ua=(t,e)=>e,yf=t=>null,ca=t=>!0,ua=(t,e)=>t==e,_f=/\.\d*?(?=9{6,}|0{6,})/gm,vr=t=>{if(Ba(t)||er.has(t))return t;let e=`${t}`,n=e.match(_f);if(n==null)return t;let r=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,i]=e.split("e");return+`${vr(s)}e${i}`}return pe(t,r)};function mr(t,e){return vr(pe(vr(t/e))*e)}function Xn(t,e){return vr(xt(vr(t/e))*e)}function Ha(t,e){return vr(ht(vr(t/e))*e)}function pe(t,e=0){if(Ba(t))return t;let n=10**e,r=t*n*(1+Number.EPSILON);return Ne(r)/n}var er=new Map;function Va(t){return((""+t).split(".")[1]||"").length}function pn(t,e,n,r){let s=[],i=r.map(Va);for(let o=e;o<n;o++){let a=De(o),l=pe(Wr(t,o),a);for(let u=0;u<r.length;u++){let d=t==10?+`${r[u]}e${o}`:r[u]*l,h=(o>=0?0:a)+(o>=i[u]?0:i[u]),p=t==10?d:pe(d,h);s.push(p),er.set(p,h)}}return s}var dn={},Li=[],zr=[null,null],Zt=Array.isArray,Ba=Number.isInteger,wf=t=>t===void 0;function fa(t){return typeof t=="string"}function $n(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function xf(t){return t!=null&&typeof t=="object"}var Ef=Object.getPrototypeOf(Uint8Array),Ga="__proto__";function jr(t,e=$n){let n;if(Zt(t)){let r=t.find(s=>s!=null);if(Zt(r)||e(r)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=jr(t[s],e)}else n=t.slice()}else if(t instanceof Ef)n=t.slice();else if(e(t)){n={};for(let r in t)r!=Ga&&(n[r]=jr(t[r],e))}else n=t;return n}function Fe(t){let e=arguments;for(let n=1;n<e.length;n++){let r=e[n];for(let s in r)s!=Ga&&($n(t[s])?Fe(t[s],jr(r[s])):t[s]=jr(r[s]))}return t}var Mf=0,Sf=1,Af=2;function Tf(t,e,n){for(let r=0,s,i=-1;r<e.length;r++){let o=e[r];if(o>i){for(s=o-1;s>=0&&t[s]==null;)t[s--]=null;for(s=o+1;s<n&&t[s]==null;)t[i=s++]=null}}}function Rf(t,e){if(kf(t)){let o=t[0].slice();for(let a=1;a<t.length;a++)o.push(...t[a].slice(1));return If(o[0])||(o=Pf(o)),o}let n=new Set;for(let o=0;o<t.length;o++){let l=t[o][0],u=l.length;for(let d=0;d<u;d++)n.add(l[d])}let r=[Array.from(n).sort((o,a)=>o-a)],s=r[0].length,i=new Map;for(let o=0;o<s;o++)i.set(r[0][o],o);for(let o=0;o<t.length;o++){let a=t[o],l=a[0];for(let u=1;u<a.length;u++){let d=a[u],h=Array(s).fill(void 0),p=e?e[o][u]:Sf,b=[];for(let _=0;_<d.length;_++){let w=d[_],S=i.get(l[_]);w===null?p!=Mf&&(h[S]=w,p==Af&&b.push(S)):h[S]=w}Tf(h,b,s),r.push(h)}}return r}var Lf=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Pf(t){let e=t[0],n=e.length,r=Array(n);for(let i=0;i<r.length;i++)r[i]=i;r.sort((i,o)=>e[i]-e[o]);let s=[];for(let i=0;i<t.length;i++){let o=t[i],a=Array(n);for(let l=0;l<n;l++)a[l]=o[r[l]];s.push(a)}return s}function kf(t){let e=t[0][0],n=e.length;for(let r=1;r<t.length;r++){let s=t[r][0];if(s.length!=n)return!1;if(s!=e){for(let i=0;i<n;i++)if(s[i]!=e[i])return!1}}return!0}function If(t,e=100){let n=t.length;if(n<=1)return!0;let r=0,s=n-1;for(;r<=s&&t[r]==null;)r++;for(;s>=r&&t[s]==null;)s--;if(s<=r)return!0;let i=Ze(1,ht((s-r+1)/e));for(let o=t[r],a=r+i;a<=s;a+=i){let l=t[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var Wa=["January","February","March","April","May","June","July","August","September","October","November","December"],za=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function ja(t){return t.slice(0,3)}var Ff=za.map(ja),Cf=Wa.map(ja),Of={MMMM:Wa,MMM:Cf,WWWW:za,WWW:Ff};function cn(t){return(t<10?"0":"")+t}function Nf(t){return(t<10?"00":t<100?"0":"")+t}var Df={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>cn(t.getMonth()+1),M:t=>t.getMonth()+1,DD:t=>cn(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>cn(t.getHours()),H:t=>t.getHours(),h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>cn(t.getMinutes()),m:t=>t.getMinutes(),ss:t=>cn(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Nf(t.getMilliseconds())};function Pi(t,e){e=e||Of;let n=[],r=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=r.exec(t);)n.push(s[0][0]=="{"?Df[s[1]]:s[0]);return i=>{let o="";for(let a=0;a<n.length;a++)o+=typeof n[a]=="string"?n[a]:n[a](i,e);return o}}var Uf=new Intl.DateTimeFormat().resolvedOptions().timeZone;function Hf(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Uf?n=t:(n=new Date(t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Ya=t=>t%1==0,jn=[1,2,2.5,5],Vf=pn(10,-32,0,jn),qa=pn(10,0,32,jn),Bf=qa.filter(Ya),dr=Vf.concat(qa),ki=`
`,Xa="{YYYY}",ha=ki+Xa,$a="{M}/{D}",hn=ki+$a,Vn=hn+"/{YY}",Ka="{aa}",Gf="{h}:{mm}",Br=Gf+Ka,ma=ki+Br,da=":{ss}",ce=null;function Qa(t){let e=t*1e3,n=e*60,r=n*60,s=r*24,i=s*30,o=s*365,l=(t==1?pn(10,0,3,jn).filter(Ya):pn(10,-3,0,jn)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,r,r*2,r*3,r*4,r*6,r*8,r*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,i,i*2,i*3,i*4,i*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),u=[[o,Xa,ce,ce,ce,ce,ce,ce,1],[s*28,"{MMM}",ha,ce,ce,ce,ce,ce,1],[s,$a,ha,ce,ce,ce,ce,ce,1],[r,"{h}"+Ka,Vn,ce,hn,ce,ce,ce,1],[n,Br,Vn,ce,hn,ce,ce,ce,1],[e,da,Vn+" "+Br,ce,hn+" "+Br,ce,ma,ce,1],[t,da+".{fff}",Vn+" "+Br,ce,hn+" "+Br,ce,ma,ce,1]];function d(h){return(p,b,_,w,S,T)=>{let x=[],A=S>=o,M=S>=i&&S<o,z=h(_),k=pe(z*t,3),U=ui(z.getFullYear(),A?0:z.getMonth(),M||A?1:z.getDate()),V=pe(U*t,3);if(M||A){let X=M?S/i:0,Y=A?S/o:0,P=k==V?k:pe(ui(U.getFullYear()+Y,U.getMonth()+X,1)*t,3),K=new Date(Ne(P/t)),D=K.getFullYear(),q=K.getMonth();for(let H=0;P<=w;H++){let J=ui(D+Y*H,q+X*H,1),W=J-h(pe(J*t,3));P=pe((+J+W)*t,3),P<=w&&x.push(P)}}else{let X=S>=s?s:S,Y=ht(_)-ht(k),P=V+Y+Xn(k-V,X);x.push(P);let K=h(P),D=K.getHours()+K.getMinutes()/n+K.getSeconds()/r,q=S/r,H=p.axes[b]._space,J=T/H;for(;P=pe(P+S,t==1?0:3),!(P>w);)if(q>1){let W=ht(pe(D+q,6))%24,ne=h(P).getHours()-W;ne>1&&(ne=-1),P-=ne*r,D=(D+q)%24;let ue=x[x.length-1];pe((P-ue)/S,3)*J>=.7&&x.push(P)}else x.push(P)}return x}}return[l,u,d]}var[Wf,zf,jf]=Qa(1),[Yf,qf,Xf]=Qa(.001);pn(2,-53,53,[1]);function pa(t,e){return t.map(n=>n.map((r,s)=>s==0||s==8||r==null?r:e(s==1||n[8]==0?r:n[1]+r)))}function ga(t,e){return(n,r,s,i,o)=>{let a=e.find(_=>o>=_[0])||e[e.length-1],l,u,d,h,p,b;return r.map(_=>{let w=t(_),S=w.getFullYear(),T=w.getMonth(),x=w.getDate(),A=w.getHours(),M=w.getMinutes(),z=w.getSeconds(),k=S!=l&&a[2]||T!=u&&a[3]||x!=d&&a[4]||A!=h&&a[5]||M!=p&&a[6]||z!=b&&a[7]||a[1];return l=S,u=T,d=x,h=A,p=M,b=z,k(w)})}}function $f(t,e){let n=Pi(e);return(r,s,i,o,a)=>s.map(l=>n(t(l)))}function ui(t,e,n){return new Date(t,e,n)}function va(t,e){return e(t)}var Kf="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function ba(t,e){return(n,r,s,i)=>i==null?Mi:e(t(r))}function Qf(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Jf(t,e){return t.series[e].fill(t,e)}var Zf={show:!0,live:!0,isolate:!1,mount:bf,markers:{show:!0,width:2,stroke:Qf,fill:Jf,dash:"solid"},idx:null,idxs:null,values:[]};function eh(t,e){let n=t.cursor.points,r=wt(),s=n.size(t,e);_e(r,un,s),_e(r,fn,s);let i=s/-2;_e(r,"marginLeft",i),_e(r,"marginTop",i);let o=n.width(t,e,s);return o&&_e(r,"borderWidth",o),r}function th(t,e){let n=t.series[e].points;return n._fill||n._stroke}function rh(t,e){let n=t.series[e].points;return n._stroke||n._fill}function nh(t,e){return t.series[e].points.size}var fi=[0,0];function sh(t,e,n){return fi[0]=e,fi[1]=n,fi}function Bn(t,e,n,r=!0){return s=>{s.button==0&&(!r||s.target==e)&&n(s)}}function hi(t,e,n,r=!0){return s=>{(!r||s.target==e)&&n(s)}}var ih={show:!0,x:!0,y:!0,lock:!1,move:sh,points:{one:!1,show:eh,size:nh,width:0,stroke:rh,fill:th},bind:{mousedown:Bn,mouseup:Bn,click:Bn,dblclick:Bn,mousemove:hi,mouseleave:hi,mouseenter:hi},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(t,e,n,r,s)=>r-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Ja={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Ii=Fe({},Ja,{filter:Ua}),Za=Fe({},Ii,{size:10}),el=Fe({},Ja,{show:!1}),Fi='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',tl="bold "+Fi,rl=1.5,ya={show:!0,scale:"x",stroke:Ei,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:tl,side:2,grid:Ii,ticks:Za,border:el,font:Fi,lineGap:rl,rotate:0},oh="Value",ah="Time",_a={show:!0,scale:"x",auto:!1,sorted:1,min:de,max:-de,idxs:[]};function lh(t,e,n,r,s){return e.map(i=>i==null?"":Ri(i))}function ch(t,e,n,r,s,i,o){let a=[],l=er.get(s)||0;n=o?n:pe(Xn(n,s),l);for(let u=n;u<=r;u=pe(u+s,l))a.push(Object.is(u,-0)?0:u);return a}function bi(t,e,n,r,s,i,o){let a=[],l=t.scales[t.axes[e].scale].log,u=l==10?jt:Oa,d=ht(u(n));s=Wr(l,d),l==10&&(s=dr[Pt(s,dr)]);let h=n,p=s*l;l==10&&(p=dr[Pt(p,dr)]);do a.push(h),h=h+s,l==10&&!er.has(h)&&(h=pe(h,er.get(s))),h>=p&&(s=h,p=s*l,l==10&&(p=dr[Pt(p,dr)]));while(h<=r);return a}function uh(t,e,n,r,s,i,o){let l=t.scales[t.axes[e].scale].asinh,u=r>l?bi(t,e,Ze(l,n),r,s):[l],d=r>=0&&n<=0?[0]:[];return(n<-l?bi(t,e,Ze(l,-r),-n,s):[l]).reverse().map(p=>-p).concat(d,u)}var nl=/./,fh=/[12357]/,hh=/[125]/,wa=/1/,yi=(t,e,n,r)=>t.map((s,i)=>e==4&&s==0||i%r==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function mh(t,e,n,r,s){let i=t.axes[n],o=i.scale,a=t.scales[o],l=t.valToPos,u=i._space,d=l(10,o),h=l(9,o)-d>=u?nl:l(7,o)-d>=u?fh:l(5,o)-d>=u?hh:wa;if(h==wa){let p=De(l(1,o)-d);if(p<u)return yi(e.slice().reverse(),a.distr,h,xt(u/p)).reverse()}return yi(e,a.distr,h,1)}function dh(t,e,n,r,s){let i=t.axes[n],o=i.scale,a=i._space,l=t.valToPos,u=De(l(1,o)-l(2,o));return u<a?yi(e.slice().reverse(),3,nl,xt(a/u)).reverse():e}function ph(t,e,n,r){return r==null?Mi:e==null?"":Ri(e)}var xa={show:!0,scale:"y",stroke:Ei,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:tl,side:3,grid:Ii,ticks:Za,border:el,font:Fi,lineGap:rl,rotate:0};function gh(t,e){let n=3+(t||1)*2;return pe(n*e,3)}function vh(t,e){let{scale:n,idxs:r}=t.series[0],s=t._data[0],i=t.valToPos(s[r[0]],n,!0),o=t.valToPos(s[r[1]],n,!0),a=De(o-i),l=t.series[e],u=a/(l.points.space*ae);return r[1]-r[0]<=u}var Ea={scale:null,auto:!0,sorted:0,min:de,max:-de},sl=(t,e,n,r,s)=>s,Ma={show:!0,auto:!0,sorted:0,gaps:sl,alpha:1,facets:[Fe({},Ea,{scale:"x"}),Fe({},Ea,{scale:"y"})]},Sa={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:sl,alpha:1,points:{show:vh,filter:null},values:null,min:de,max:-de,idxs:[],path:null,clip:null};function bh(t,e,n,r,s){return n/10}var il={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},yh=Fe({},il,{time:!1,ori:1}),Aa={};function ol(t,e){let n=Aa[t];return n||(n={key:t,plots:[],sub(r){n.plots.push(r)},unsub(r){n.plots=n.plots.filter(s=>s!=r)},pub(r,s,i,o,a,l,u){for(let d=0;d<n.plots.length;d++)n.plots[d]!=s&&n.plots[d].pub(r,s,i,o,a,l,u)}},t!=null&&(Aa[t]=n)),n}var Yr=1,_i=2;function br(t,e,n){let r=t.mode,s=t.series[e],i=r==2?t._data[e]:t._data,o=t.scales,a=t.bbox,l=i[0],u=r==2?i[1]:i[e],d=r==2?o[s.facets[0].scale]:o[t.series[0].scale],h=r==2?o[s.facets[1].scale]:o[s.scale],p=a.left,b=a.top,_=a.width,w=a.height,S=t.valToPosH,T=t.valToPosV;return d.ori==0?n(s,l,u,d,h,S,T,p,b,_,w,Qn,Xr,Zn,ll,ul):n(s,l,u,d,h,T,S,b,p,w,_,Jn,$r,Ni,cl,fl)}function Ci(t,e){let n=0,r=0,s=ie(t.bands,Li);for(let i=0;i<s.length;i++){let o=s[i];o.series[0]==e?n=o.dir:o.series[1]==e&&(o.dir==1?r|=1:r|=2)}return[n,r==1?-1:r==2?1:r==3?2:0]}function _h(t,e,n,r,s){let i=t.mode,o=t.series[e],a=i==2?o.facets[1].scale:o.scale,l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Yt(t,e,n,r,s,i){return br(t,e,(o,a,l,u,d,h,p,b,_,w,S)=>{let T=o.pxRound,x=u.dir*(u.ori==0?1:-1),A=u.ori==0?Xr:$r,M,z;x==1?(M=n,z=r):(M=r,z=n);let k=T(h(a[M],u,w,b)),U=T(p(l[M],d,S,_)),V=T(h(a[z],u,w,b)),X=T(p(i==1?d.max:d.min,d,S,_)),Y=new Path2D(s);return A(Y,V,X),A(Y,k,X),A(Y,k,U),Y})}function Kn(t,e,n,r,s,i){let o=null;if(t.length>0){o=new Path2D;let a=e==0?Zn:Ni,l=n;for(let h=0;h<t.length;h++){let p=t[h];if(p[1]>p[0]){let b=p[0]-l;b>0&&a(o,l,r,b,r+i),l=p[1]}}let u=n+s-l,d=10;u>0&&a(o,l,r-d/2,u,r+i+d)}return o}function wh(t,e,n){let r=t[t.length-1];r&&r[0]==e?r[1]=n:t.push([e,n])}function Oi(t,e,n,r,s,i,o){let a=[],l=t.length;for(let u=s==1?n:r;u>=n&&u<=r;u+=s)if(e[u]===null){let h=u,p=u;if(s==1)for(;++u<=r&&e[u]===null;)p=u;else for(;--u>=n&&e[u]===null;)p=u;let b=i(t[h]),_=p==h?b:i(t[p]),w=h-s;b=o<=0&&w>=0&&w<l?i(t[w]):b;let T=p+s;_=o>=0&&T>=0&&T<l?i(t[T]):_,_>=b&&a.push([b,_])}return a}function Ta(t){return t==0?Da:t==1?Ne:e=>mr(e,t)}function al(t){let e=t==0?Qn:Jn,n=t==0?(s,i,o,a,l,u)=>{s.arcTo(i,o,a,l,u)}:(s,i,o,a,l,u)=>{s.arcTo(o,i,l,a,u)},r=t==0?(s,i,o,a,l)=>{s.rect(i,o,a,l)}:(s,i,o,a,l)=>{s.rect(o,i,l,a)};return(s,i,o,a,l,u=0,d=0)=>{u==0&&d==0?r(s,i,o,a,l):(u=kt(u,a/2,l/2),d=kt(d,a/2,l/2),e(s,i+u,o),n(s,i+a,o,i+a,o+l,u),n(s,i+a,o+l,i,o+l,d),n(s,i,o+l,i,o,d),n(s,i,o,i+a,o,u),s.closePath())}}var Qn=(t,e,n)=>{t.moveTo(e,n)},Jn=(t,e,n)=>{t.moveTo(n,e)},Xr=(t,e,n)=>{t.lineTo(e,n)},$r=(t,e,n)=>{t.lineTo(n,e)},Zn=al(0),Ni=al(1),ll=(t,e,n,r,s,i)=>{t.arc(e,n,r,s,i)},cl=(t,e,n,r,s,i)=>{t.arc(n,e,r,s,i)},ul=(t,e,n,r,s,i,o)=>{t.bezierCurveTo(e,n,r,s,i,o)},fl=(t,e,n,r,s,i,o)=>{t.bezierCurveTo(n,e,s,r,o,i)};function hl(t){return(e,n,r,s,i)=>br(e,n,(o,a,l,u,d,h,p,b,_,w,S)=>{let{pxRound:T,points:x}=o,A,M;u.ori==0?(A=Qn,M=ll):(A=Jn,M=cl);let z=pe(x.width*ae,3),k=(x.size-x.width)/2*ae,U=pe(k*2,3),V=new Path2D,X=new Path2D,{left:Y,top:P,width:K,height:D}=e.bbox;Zn(X,Y-U,P-U,K+U*2,D+U*2);let q=H=>{if(l[H]!=null){let J=T(h(a[H],u,w,b)),W=T(p(l[H],d,S,_));A(V,J+k,W),M(V,J,W,k,0,Gn*2)}};if(i)i.forEach(q);else for(let H=r;H<=s;H++)q(H);return{stroke:z>0?V:null,fill:V,clip:X,flags:Yr|_i}})}function ml(t){return(e,n,r,s,i,o)=>{r!=s&&(i!=r&&o!=r&&t(e,n,r),i!=s&&o!=s&&t(e,n,s),t(e,n,o))}}var xh=ml(Xr),Eh=ml($r);function dl(t){let e=ie(t?.alignGaps,0);return(n,r,s,i)=>br(n,r,(o,a,l,u,d,h,p,b,_,w,S)=>{[s,i]=Yn(l,s,i);let T=o.pxRound,x=D=>T(h(D,u,w,b)),A=D=>T(p(D,d,S,_)),M,z;u.ori==0?(M=Xr,z=xh):(M=$r,z=Eh);let k=u.dir*(u.ori==0?1:-1),U={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Yr},V=U.stroke,X=!1;if(i-s>=w*4){let D=B=>n.posToVal(B,u.key,!0),q=null,H=null,J,W,et,we=x(a[k==1?s:i]),ne=x(a[s]),ue=x(a[i]),ee=D(k==1?ne+1:ue-1);for(let B=k==1?s:i;B>=s&&B<=i;B+=k){let Ce=a[B],xe=(k==1?Ce<ee:Ce>ee)?we:x(Ce),le=l[B];xe==we?le!=null?(W=le,q==null?(M(V,xe,A(W)),J=q=H=W):W<q?q=W:W>H&&(H=W)):le===null&&(X=!0):(q!=null&&z(V,we,A(q),A(H),A(J),A(W)),le!=null?(W=le,M(V,xe,A(W)),q=H=J=W):(q=H=null,le===null&&(X=!0)),we=xe,ee=D(we+k))}q!=null&&q!=H&&et!=we&&z(V,we,A(q),A(H),A(J),A(W))}else for(let D=k==1?s:i;D>=s&&D<=i;D+=k){let q=l[D];q===null?X=!0:q!=null&&M(V,x(a[D]),A(q))}let[P,K]=Ci(n,r);if(o.fill!=null||P!=0){let D=U.fill=new Path2D(V),q=o.fillTo(n,r,o.min,o.max,P),H=A(q),J=x(a[s]),W=x(a[i]);k==-1&&([W,J]=[J,W]),M(D,W,H),M(D,J,H)}if(!o.spanGaps){let D=[];X&&D.push(...Oi(a,l,s,i,k,x,e)),U.gaps=D=o.gaps(n,r,s,i,D),U.clip=Kn(D,u.ori,b,_,w,S)}return K!=0&&(U.band=K==2?[Yt(n,r,s,i,V,-1),Yt(n,r,s,i,V,1)]:Yt(n,r,s,i,V,K)),U})}function Mh(t){let e=ie(t.align,1),n=ie(t.ascDesc,!1),r=ie(t.alignGaps,0),s=ie(t.extend,!1);return(i,o,a,l)=>br(i,o,(u,d,h,p,b,_,w,S,T,x,A)=>{[a,l]=Yn(h,a,l);let M=u.pxRound,{left:z,width:k}=i.bbox,U=ne=>M(_(ne,p,x,S)),V=ne=>M(w(ne,b,A,T)),X=p.ori==0?Xr:$r,Y={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Yr},P=Y.stroke,K=p.dir*(p.ori==0?1:-1),D=V(h[K==1?a:l]),q=U(d[K==1?a:l]),H=q,J=q;s&&e==-1&&(J=z,X(P,J,D)),X(P,q,D);for(let ne=K==1?a:l;ne>=a&&ne<=l;ne+=K){let ue=h[ne];if(ue==null)continue;let ee=U(d[ne]),B=V(ue);e==1?X(P,ee,D):X(P,H,B),X(P,ee,B),D=B,H=ee}let W=H;s&&e==1&&(W=z+k,X(P,W,D));let[et,we]=Ci(i,o);if(u.fill!=null||et!=0){let ne=Y.fill=new Path2D(P),ue=u.fillTo(i,o,u.min,u.max,et),ee=V(ue);X(ne,W,ee),X(ne,J,ee)}if(!u.spanGaps){let ne=[];ne.push(...Oi(d,h,a,l,K,U,r));let ue=u.width*ae/2,ee=n||e==1?ue:-ue,B=n||e==-1?-ue:ue;ne.forEach(Ce=>{Ce[0]+=ee,Ce[1]+=B}),Y.gaps=ne=u.gaps(i,o,a,l,ne),Y.clip=Kn(ne,p.ori,S,T,x,A)}return we!=0&&(Y.band=we==2?[Yt(i,o,a,l,P,-1),Yt(i,o,a,l,P,1)]:Yt(i,o,a,l,P,we)),Y})}function Ra(t,e,n,r,s,i,o=de){if(t.length>1){let a=null;for(let l=0,u=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let d=De(t[l]-t[a]);d<u&&(u=d,o=De(n(t[l],r,s,i)-n(t[a],r,s,i)))}a=l}}return o}function Sh(t){t=t||dn;let e=ie(t.size,[.6,de,1]),n=t.align||0,r=t.gap||0,s=t.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let i=re(s),o=1-e[0],a=ie(e[1],de),l=ie(e[2],1),u=ie(t.disp,dn),d=ie(t.each,b=>{}),{fill:h,stroke:p}=u;return(b,_,w,S)=>br(b,_,(T,x,A,M,z,k,U,V,X,Y,P)=>{let K=T.pxRound,D=n,q=r*ae,H=a*ae,J=l*ae,W,et;M.ori==0?[W,et]=i(b,_):[et,W]=i(b,_);let we=M.dir*(M.ori==0?1:-1),ne=M.ori==0?Zn:Ni,ue=M.ori==0?d:(C,ge,Oe,Er,sr,Ct,ir)=>{d(C,ge,Oe,sr,Er,ir,Ct)},ee=ie(b.bands,Li).find(C=>C.series[0]==_),B=ee!=null?ee.dir:0,Ce=T.fillTo(b,_,T.min,T.max,B),Xe=K(U(Ce,z,P,X)),xe,le,Mt,it=Y,Se=K(T.width*ae),Ft=!1,Bt=null,dt=null,qt=null,_r=null;h!=null&&(Se==0||p!=null)&&(Ft=!0,Bt=h.values(b,_,w,S),dt=new Map,new Set(Bt).forEach(C=>{C!=null&&dt.set(C,new Path2D)}),Se>0&&(qt=p.values(b,_,w,S),_r=new Map,new Set(qt).forEach(C=>{C!=null&&_r.set(C,new Path2D)})));let{x0:wr,size:Jr}=u;if(wr!=null&&Jr!=null){D=1,x=wr.values(b,_,w,S),wr.unit==2&&(x=x.map(Oe=>b.posToVal(V+Oe*Y,M.key,!0)));let C=Jr.values(b,_,w,S);Jr.unit==2?le=C[0]*Y:le=k(C[0],M,Y,V)-k(0,M,Y,V),it=Ra(x,A,k,M,Y,V,it),Mt=it-le+q}else it=Ra(x,A,k,M,Y,V,it),Mt=it*o+q,le=it-Mt;Mt<1&&(Mt=0),Se>=le/2&&(Se=0),Mt<5&&(K=Da);let En=Mt>0,rr=it-Mt-(En?Se:0);le=K(vi(rr,J,H)),xe=(D==0?le/2:D==we?0:le)-D*we*((D==0?q/2:0)+(En?Se/2:0));let $e={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},xr=Ft?null:new Path2D,Gt=null;if(ee!=null)Gt=b.data[ee.series[1]];else{let{y0:C,y1:ge}=u;C!=null&&ge!=null&&(A=ge.values(b,_,w,S),Gt=C.values(b,_,w,S))}let nr=W*le,Z=et*le;for(let C=we==1?w:S;C>=w&&C<=S;C+=we){let ge=A[C];if(ge==null)continue;if(Gt!=null){let tt=Gt[C]??0;if(ge-tt==0)continue;Xe=U(tt,z,P,X)}let Oe=M.distr!=2||u!=null?x[C]:C,Er=k(Oe,M,Y,V),sr=U(ie(ge,Ce),z,P,X),Ct=K(Er-xe),ir=K(Ze(sr,Xe)),ot=K(kt(sr,Xe)),pt=ir-ot;if(ge!=null){let tt=ge<0?Z:nr,St=ge<0?nr:Z;Ft?(Se>0&&qt[C]!=null&&ne(_r.get(qt[C]),Ct,ot+ht(Se/2),le,Ze(0,pt-Se),tt,St),Bt[C]!=null&&ne(dt.get(Bt[C]),Ct,ot+ht(Se/2),le,Ze(0,pt-Se),tt,St)):ne(xr,Ct,ot+ht(Se/2),le,Ze(0,pt-Se),tt,St),ue(b,_,C,Ct-Se/2,ot,le+Se,pt)}}return Se>0?$e.stroke=Ft?_r:xr:Ft||($e._fill=T.width==0?T._fill:T._stroke??T._fill,$e.width=0),$e.fill=Ft?dt:xr,$e})}function Ah(t,e){let n=ie(e?.alignGaps,0);return(r,s,i,o)=>br(r,s,(a,l,u,d,h,p,b,_,w,S,T)=>{[i,o]=Yn(u,i,o);let x=a.pxRound,A=W=>x(p(W,d,S,_)),M=W=>x(b(W,h,T,w)),z,k,U;d.ori==0?(z=Qn,U=Xr,k=ul):(z=Jn,U=$r,k=fl);let V=d.dir*(d.ori==0?1:-1),X=A(l[V==1?i:o]),Y=X,P=[],K=[];for(let W=V==1?i:o;W>=i&&W<=o;W+=V)if(u[W]!=null){let we=l[W],ne=A(we);P.push(Y=ne),K.push(M(u[W]))}let D={stroke:t(P,K,z,U,k,x),fill:null,clip:null,band:null,gaps:null,flags:Yr},q=D.stroke,[H,J]=Ci(r,s);if(a.fill!=null||H!=0){let W=D.fill=new Path2D(q),et=a.fillTo(r,s,a.min,a.max,H),we=M(et);U(W,Y,we),U(W,X,we)}if(!a.spanGaps){let W=[];W.push(...Oi(l,u,i,o,V,A,n)),D.gaps=W=a.gaps(r,s,i,o,W),D.clip=Kn(W,d.ori,_,w,S,T)}return J!=0&&(D.band=J==2?[Yt(r,s,i,o,q,-1),Yt(r,s,i,o,q,1)]:Yt(r,s,i,o,q,J)),D})}function Th(t){return Ah(Rh,t)}function Rh(t,e,n,r,s,i){let o=t.length;if(o<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),o==2)r(a,t[1],e[1]);else{let l=Array(o),u=Array(o-1),d=Array(o-1),h=Array(o-1);for(let p=0;p<o-1;p++)d[p]=e[p+1]-e[p],h[p]=t[p+1]-t[p],u[p]=d[p]/h[p];l[0]=u[0];for(let p=1;p<o-1;p++)u[p]===0||u[p-1]===0||u[p-1]>0!=u[p]>0?l[p]=0:(l[p]=3*(h[p-1]+h[p])/((2*h[p]+h[p-1])/u[p-1]+(h[p]+2*h[p-1])/u[p]),isFinite(l[p])||(l[p]=0));l[o-1]=u[o-2];for(let p=0;p<o-1;p++)s(a,t[p]+h[p]/3,e[p]+l[p]*h[p]/3,t[p+1]-h[p]/3,e[p+1]-l[p+1]*h[p]/3,t[p+1],e[p+1])}return a}var wi=new Set;function La(){for(let t of wi)t.syncRect(!0)}qr&&(gr(lf,Gr,La),gr(cf,Gr,La,!0),gr(Wn,Gr,()=>{ze.pxRatio=ae}));var Lh=dl(),Ph=hl();function Pa(t,e,n,r){return(r?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((i,o)=>xi(i,o,e,n))}function kh(t,e){return t.map((n,r)=>r==0?{}:Fe({},e,n))}function xi(t,e,n,r){return Fe({},e==0?n:r,t)}function pl(t,e,n){return e==null?zr:[e,n]}var Ih=pl;function Fh(t,e,n){return e==null?zr:zn(e,n,Ti,!0)}function gl(t,e,n,r){return e==null?zr:qn(e,n,t.scales[r].log,!1)}var Ch=gl;function vl(t,e,n,r){return e==null?zr:Ai(e,n,t.scales[r].log,!1)}var Oh=vl;function Nh(t,e,n,r,s){let i=Ze(la(t),la(e)),o=e-t,a=Pt(s/r*o,n);do{let l=n[a],u=r*l/o;if(u>=s&&i+(l<5?er.get(l):0)<=17)return[l,u]}while(++a<n.length);return[0,0]}function ka(t){let e,n;return t=t.replace(/(\d+)px/,(r,s)=>(e=Ne((n=+s)*ae))+"px"),[t,e,n]}function Dh(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=pe(e[2]*ae,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),e[1]=n})}function ze(t,e,n){let r={mode:ie(t.mode,1)},s=r.mode;function i(c,f,m,g){let v=f.valToPct(c);return g+m*(f.dir==-1?1-v:v)}function o(c,f,m,g){let v=f.valToPct(c);return g+m*(f.dir==-1?v:1-v)}function a(c,f,m,g){return f.ori==0?i(c,f,m,g):o(c,f,m,g)}r.valToPosH=i,r.valToPosV=o;let l=!1;r.status=0;let u=r.root=wt(Wu);if(t.id!=null&&(u.id=t.id),ft(u,t.class),t.title){let c=wt(Yu,u);c.textContent=t.title}let d=Lt("canvas"),h=r.ctx=d.getContext("2d"),p=wt(qu,u);gr("click",p,c=>{c.target===_&&(ve!=Cr||Ee!=Or)&&Ye.click(r,c)},!0);let b=r.under=wt(Xu,p);p.appendChild(d);let _=r.over=wt($u,p);t=jr(t);let w=+ie(t.pxAlign,1),S=Ta(w);(t.plugins||[]).forEach(c=>{c.opts&&(t=c.opts(r,t)||t)});let T=t.ms||.001,x=r.series=s==1?Pa(t.series||[],_a,Sa,!1):kh(t.series||[null],Ma),A=r.axes=Pa(t.axes||[],ya,xa,!0),M=r.scales={},z=r.bands=t.bands||[];z.forEach(c=>{c.fill=re(c.fill||null),c.dir=ie(c.dir,-1)});let k=s==2?x[1].facets[0].scale:x[0].scale,U={axes:xu,series:vu},V=(t.drawOrder||["axes","series"]).map(c=>U[c]);function X(c){let f=c.distr==3?m=>jt(m>0?m:c.clamp(r,m,c.min,c.max,c.key)):c.distr==4?m=>ci(m,c.asinh):c.distr==100?m=>c.fwd(m):m=>m;return m=>{let g=f(m),{_min:v,_max:y}=c,E=y-v;return(g-v)/E}}function Y(c){let f=M[c];if(f==null){let m=(t.scales||dn)[c]||dn;if(m.from!=null){Y(m.from);let g=Fe({},M[m.from],m,{key:c});g.valToPct=X(g),M[c]=g}else{f=M[c]=Fe({},c==k?il:yh,m),f.key=c;let g=f.time,v=f.range,y=Zt(v);if((c!=k||s==2&&!g)&&(y&&(v[0]==null||v[1]==null)&&(v={min:v[0]==null?ia:{mode:1,hard:v[0],soft:v[0]},max:v[1]==null?ia:{mode:1,hard:v[1],soft:v[1]}},y=!1),!y&&$n(v))){let E=v;v=(R,L,I)=>L==null?zr:zn(L,I,E)}f.range=re(v||(g?Ih:c==k?f.distr==3?Ch:f.distr==4?Oh:pl:f.distr==3?gl:f.distr==4?vl:Fh)),f.auto=re(y?!1:f.auto),f.clamp=re(f.clamp||bh),f._min=f._max=null,f.valToPct=X(f)}}}Y("x"),Y("y"),s==1&&x.forEach(c=>{Y(c.scale)}),A.forEach(c=>{Y(c.scale)});for(let c in t.scales)Y(c);let P=M[k],K=P.distr,D,q;P.ori==0?(ft(u,zu),D=i,q=o):(ft(u,ju),D=o,q=i);let H={};for(let c in M){let f=M[c];(f.min!=null||f.max!=null)&&(H[c]={min:f.min,max:f.max},f.min=f.max=null)}let J=t.tzDate||(c=>new Date(Ne(c/T))),W=t.fmtDate||Pi,et=T==1?jf(J):Xf(J),we=ga(J,pa(T==1?zf:qf,W)),ne=ba(J,va(Kf,W)),ue=[],ee=r.legend=Fe({},Zf,t.legend),B=r.cursor=Fe({},ih,{drag:{y:s==2}},t.cursor),Ce=ee.show,Xe=B.show,xe=ee.markers;ee.idxs=ue,xe.width=re(xe.width),xe.dash=re(xe.dash),xe.stroke=re(xe.stroke),xe.fill=re(xe.fill);let le,Mt,it,Se=[],Ft=[],Bt,dt=!1,qt={};if(ee.live){let c=x[1]?x[1].values:null;dt=c!=null,Bt=dt?c(r,1,0):{_:0};for(let f in Bt)qt[f]=Mi}if(Ce)if(le=Lt("table",tf,u),it=Lt("tbody",null,le),ee.mount(r,le),dt){Mt=Lt("thead",null,le,it);let c=Lt("tr",null,Mt);Lt("th",null,c);for(var _r in Bt)Lt("th",Yo,c).textContent=_r}else ft(le,nf),ee.live&&ft(le,rf);let wr={show:!0},Jr={show:!1};function En(c,f){if(f==0&&(dt||!ee.live||s==2))return zr;let m=[],g=Lt("tr",sf,it,it.childNodes[f]);ft(g,c.class),c.show||ft(g,pr);let v=Lt("th",null,g);if(xe.show){let R=wt(of,v);if(f>0){let L=xe.width(r,f);L&&(R.style.border=L+"px "+xe.dash(r,f)+" "+xe.stroke(r,f)),R.style.background=xe.fill(r,f)}}let y=wt(Yo,v);c.label instanceof HTMLElement?y.appendChild(c.label):y.textContent=c.label,f>0&&(xe.show||(y.style.color=c.width>0?xe.stroke(r,f):xe.fill(r,f)),$e("click",v,R=>{if(B._lock)return;ar(R);let L=x.indexOf(c);if((R.ctrlKey||R.metaKey)!=ee.isolate){let I=x.some((F,O)=>O>0&&O!=L&&F.show);x.forEach((F,O)=>{O>0&&Nt(O,I?O==L?wr:Jr:wr,!0,ke.setSeries)})}else Nt(L,{show:!c.show},!0,ke.setSeries)},!1),Sr&&$e(Ko,v,R=>{B._lock||(ar(R),Nt(x.indexOf(c),Dr,!0,ke.setSeries))},!1));for(var E in Bt){let R=Lt("td",af,g);R.textContent="--",m.push(R)}return[g,m]}let rr=new Map;function $e(c,f,m,g=!0){let v=rr.get(f)||{},y=B.bind[c](r,f,m,g);y&&(gr(c,f,v[c]=y),rr.set(f,v))}function xr(c,f,m){let g=rr.get(f)||{};for(let v in g)(c==null||v==c)&&(gi(v,f,g[v]),delete g[v]);c==null&&rr.delete(f)}let Gt=0,nr=0,Z=0,C=0,ge=0,Oe=0,Er=ge,sr=Oe,Ct=Z,ir=C,ot=0,pt=0,tt=0,St=0;r.bbox={};let ks=!1,Mn=!1,Mr=!1,or=!1,Sn=!1,gt=!1;function Is(c,f,m){(m||c!=r.width||f!=r.height)&&no(c,f),Pr(!1),Mr=!0,Mn=!0,kr()}function no(c,f){r.width=Gt=Z=c,r.height=nr=C=f,ge=Oe=0,uu(),fu();let m=r.bbox;ot=m.left=mr(ge*ae,.5),pt=m.top=mr(Oe*ae,.5),tt=m.width=mr(Z*ae,.5),St=m.height=mr(C*ae,.5)}let au=3;function lu(){let c=!1,f=0;for(;!c;){f++;let m=_u(f),g=wu(f);c=f==au||m&&g,c||(no(r.width,r.height),Mn=!0)}}function cu({width:c,height:f}){Is(c,f)}r.setSize=cu;function uu(){let c=!1,f=!1,m=!1,g=!1;A.forEach((v,y)=>{if(v.show&&v._show){let{side:E,_size:R}=v,L=E%2,I=v.label!=null?v.labelSize:0,F=R+I;F>0&&(L?(Z-=F,E==3?(ge+=F,g=!0):m=!0):(C-=F,E==0?(Oe+=F,c=!0):f=!0))}}),lr[0]=c,lr[1]=m,lr[2]=f,lr[3]=g,Z-=Xt[1]+Xt[3],ge+=Xt[3],C-=Xt[2]+Xt[0],Oe+=Xt[0]}function fu(){let c=ge+Z,f=Oe+C,m=ge,g=Oe;function v(y,E){switch(y){case 1:return c+=E,c-E;case 2:return f+=E,f-E;case 3:return m-=E,m+E;case 0:return g-=E,g+E}}A.forEach((y,E)=>{if(y.show&&y._show){let R=y.side;y._pos=v(R,y._size),y.label!=null&&(y._lpos=v(R,y.labelSize))}})}if(B.dataIdx==null){let c=B.hover,f=c.skip=new Set(c.skip??[]);f.add(void 0);let m=c.prox=re(c.prox),g=c.bias??=0;B.dataIdx=(v,y,E,R)=>{if(y==0)return E;let L=E,I=m(v,y,E,R)??de,F=I>=0&&I<de,O=P.ori==0?Z:C,Q=B.left,oe=e[0],se=e[y];if(f.has(se[E])){L=null;let te=null,$=null,G;if(g==0||g==-1)for(G=E;te==null&&G-- >0;)f.has(se[G])||(te=G);if(g==0||g==1)for(G=E;$==null&&G++<se.length;)f.has(se[G])||($=G);if(te!=null||$!=null)if(F){let ye=te==null?-1/0:D(oe[te],P,O,0),Ae=$==null?1/0:D(oe[$],P,O,0),We=Q-ye,fe=Ae-Q;We<=fe?We<=I&&(L=te):fe<=I&&(L=$)}else L=$==null?te:te==null?$:E-te<=$-E?te:$}else F&&De(Q-D(oe[E],P,O,0))>I&&(L=null);return L}}let ar=c=>{B.event=c};B.idxs=ue,B._lock=!1;let qe=B.points;qe.show=re(qe.show),qe.size=re(qe.size),qe.stroke=re(qe.stroke),qe.width=re(qe.width),qe.fill=re(qe.fill);let Ot=r.focus=Fe({},t.focus||{alpha:.3},B.focus),Sr=Ot.prox>=0,Ar=Sr&&qe.one,vt=[],Tr=[],Rr=[];function so(c,f){let m=qe.show(r,f);if(m instanceof HTMLElement)return ft(m,ef),ft(m,c.class),Vt(m,-10,-10,Z,C),_.insertBefore(m,vt[f]),m}function io(c,f){if(s==1||f>0){let m=s==1&&M[c.scale].time,g=c.value;c.value=m?fa(g)?ba(J,va(g,W)):g||ne:g||ph,c.label=c.label||(m?ah:oh)}if(Ar||f>0){c.width=c.width==null?1:c.width,c.paths=c.paths||Lh||yf,c.fillTo=re(c.fillTo||_h),c.pxAlign=+ie(c.pxAlign,w),c.pxRound=Ta(c.pxAlign),c.stroke=re(c.stroke||null),c.fill=re(c.fill||null),c._stroke=c._fill=c._paths=c._focus=null;let m=gh(Ze(1,c.width),1),g=c.points=Fe({},{size:m,width:Ze(1,m*.2),stroke:c.stroke,space:m*2,paths:Ph,_stroke:null,_fill:null},c.points);g.show=re(g.show),g.filter=re(g.filter),g.fill=re(g.fill),g.stroke=re(g.stroke),g.paths=re(g.paths),g.pxAlign=c.pxAlign}if(Ce){let m=En(c,f);Se.splice(f,0,m[0]),Ft.splice(f,0,m[1]),ee.values.push(null)}if(Xe){ue.splice(f,0,null);let m=null;Ar?f==0&&(m=so(c,f)):f>0&&(m=so(c,f)),vt.splice(f,0,m),Tr.splice(f,0,0),Rr.splice(f,0,0)}Ge("addSeries",f)}function hu(c,f){f=f??x.length,c=s==1?xi(c,f,_a,Sa):xi(c,f,{},Ma),x.splice(f,0,c),io(x[f],f)}r.addSeries=hu;function mu(c){if(x.splice(c,1),Ce){ee.values.splice(c,1),Ft.splice(c,1);let f=Se.splice(c,1)[0];xr(null,f.firstChild),f.remove()}Xe&&(ue.splice(c,1),vt.splice(c,1)[0].remove(),Tr.splice(c,1),Rr.splice(c,1)),Ge("delSeries",c)}r.delSeries=mu;let lr=[!1,!1,!1,!1];function du(c,f){if(c._show=c.show,c.show){let m=c.side%2,g=M[c.scale];g==null&&(c.scale=m?x[1].scale:k,g=M[c.scale]);let v=g.time;c.size=re(c.size),c.space=re(c.space),c.rotate=re(c.rotate),Zt(c.incrs)&&c.incrs.forEach(E=>{!er.has(E)&&er.set(E,Va(E))}),c.incrs=re(c.incrs||(g.distr==2?Bf:v?T==1?Wf:Yf:dr)),c.splits=re(c.splits||(v&&g.distr==1?et:g.distr==3?bi:g.distr==4?uh:ch)),c.stroke=re(c.stroke),c.grid.stroke=re(c.grid.stroke),c.ticks.stroke=re(c.ticks.stroke),c.border.stroke=re(c.border.stroke);let y=c.values;c.values=Zt(y)&&!Zt(y[0])?re(y):v?Zt(y)?ga(J,pa(y,W)):fa(y)?$f(J,y):y||we:y||lh,c.filter=re(c.filter||(g.distr>=3&&g.log==10?mh:g.distr==3&&g.log==2?dh:Ua)),c.font=ka(c.font),c.labelFont=ka(c.labelFont),c._size=c.size(r,null,f,0),c._space=c._rotate=c._incrs=c._found=c._splits=c._values=null,c._size>0&&(lr[f]=!0,c._el=wt(Ku,p))}}function Zr(c,f,m,g){let[v,y,E,R]=m,L=f%2,I=0;return L==0&&(R||y)&&(I=f==0&&!v||f==2&&!E?Ne(ya.size/3):0),L==1&&(v||E)&&(I=f==1&&!y||f==3&&!R?Ne(xa.size/2):0),I}let oo=r.padding=(t.padding||[Zr,Zr,Zr,Zr]).map(c=>re(ie(c,Zr))),Xt=r._padding=oo.map((c,f)=>c(r,f,lr,0)),je,Ue=null,He=null,An=s==1?x[0].idxs:null,At=null,en=!1;function ao(c,f){if(e=c??[],r.data=r._data=e,s==2){je=0;for(let m=1;m<x.length;m++)je+=e[m][0].length}else{e.length==0&&(r.data=r._data=e=[[]]),At=e[0],je=At.length;let m=e;if(K==2){m=e.slice();let g=m[0]=Array(je);for(let v=0;v<je;v++)g[v]=v}r._data=e=m}if(Pr(!0),Ge("setData"),K==2&&(Mr=!0),f!==!1){let m=P;m.auto(r,en)?Fs():Kt(k,m.min,m.max),or=or||B.left>=0,gt=!0,kr()}}r.setData=ao;function Fs(){en=!0;let c,f;s==1&&(je>0?(Ue=An[0]=0,He=An[1]=je-1,c=e[0][Ue],f=e[0][He],K==2?(c=Ue,f=He):c==f&&(K==3?[c,f]=qn(c,c,P.log,!1):K==4?[c,f]=Ai(c,c,P.log,!1):P.time?f=c+Ne(86400/T):[c,f]=zn(c,f,Ti,!0))):(Ue=An[0]=c=null,He=An[1]=f=null)),Kt(k,c,f)}let Tn,Lr,Cs,Os,Ns,Ds,Us,Hs,Vs,rt;function lo(c,f,m,g,v,y){c??=Xo,m??=Li,g??="butt",v??=Xo,y??="round",c!=Tn&&(h.strokeStyle=Tn=c),v!=Lr&&(h.fillStyle=Lr=v),f!=Cs&&(h.lineWidth=Cs=f),y!=Ns&&(h.lineJoin=Ns=y),g!=Ds&&(h.lineCap=Ds=g),m!=Os&&h.setLineDash(Os=m)}function co(c,f,m,g){f!=Lr&&(h.fillStyle=Lr=f),c!=Us&&(h.font=Us=c),m!=Hs&&(h.textAlign=Hs=m),g!=Vs&&(h.textBaseline=Vs=g)}function Bs(c,f,m,g,v=0){if(g.length>0&&c.auto(r,en)&&(f==null||f.min==null)){let y=ie(Ue,0),E=ie(He,g.length-1),R=m.min==null?mf(g,y,E,v,c.distr==3):[m.min,m.max];c.min=kt(c.min,m.min=R[0]),c.max=Ze(c.max,m.max=R[1])}}let uo={min:null,max:null};function pu(){for(let g in M){let v=M[g];H[g]==null&&(v.min==null||H[k]!=null&&v.auto(r,en))&&(H[g]=uo)}for(let g in M){let v=M[g];H[g]==null&&v.from!=null&&H[v.from]!=null&&(H[g]=uo)}H[k]!=null&&Pr(!0);let c={};for(let g in H){let v=H[g];if(v!=null){let y=c[g]=jr(M[g],xf);if(v.min!=null)Fe(y,v);else if(g!=k||s==2)if(je==0&&y.from==null){let E=y.range(r,null,null,g);y.min=E[0],y.max=E[1]}else y.min=de,y.max=-de}}if(je>0){x.forEach((g,v)=>{if(s==1){let y=g.scale,E=H[y];if(E==null)return;let R=c[y];if(v==0){let L=R.range(r,R.min,R.max,y);R.min=L[0],R.max=L[1],Ue=Pt(R.min,e[0]),He=Pt(R.max,e[0]),He-Ue>1&&(e[0][Ue]<R.min&&Ue++,e[0][He]>R.max&&He--),g.min=At[Ue],g.max=At[He]}else g.show&&g.auto&&Bs(R,E,g,e[v],g.sorted);g.idxs[0]=Ue,g.idxs[1]=He}else if(v>0&&g.show&&g.auto){let[y,E]=g.facets,R=y.scale,L=E.scale,[I,F]=e[v],O=c[R],Q=c[L];O!=null&&Bs(O,H[R],y,I,y.sorted),Q!=null&&Bs(Q,H[L],E,F,E.sorted),g.min=E.min,g.max=E.max}});for(let g in c){let v=c[g],y=H[g];if(v.from==null&&(y==null||y.min==null)){let E=v.range(r,v.min==de?null:v.min,v.max==-de?null:v.max,g);v.min=E[0],v.max=E[1]}}}for(let g in c){let v=c[g];if(v.from!=null){let y=c[v.from];if(y.min==null)v.min=v.max=null;else{let E=v.range(r,y.min,y.max,g);v.min=E[0],v.max=E[1]}}}let f={},m=!1;for(let g in c){let v=c[g],y=M[g];if(y.min!=v.min||y.max!=v.max){y.min=v.min,y.max=v.max;let E=y.distr;y._min=E==3?jt(y.min):E==4?ci(y.min,y.asinh):E==100?y.fwd(y.min):y.min,y._max=E==3?jt(y.max):E==4?ci(y.max,y.asinh):E==100?y.fwd(y.max):y.max,f[g]=m=!0}}if(m){x.forEach((g,v)=>{s==2?v>0&&f.y&&(g._paths=null):f[g.scale]&&(g._paths=null)});for(let g in f)Mr=!0,Ge("setScale",g);Xe&&B.left>=0&&(or=gt=!0)}for(let g in H)H[g]=null}function gu(c){let f=vi(Ue-1,0,je-1),m=vi(He+1,0,je-1);for(;c[f]==null&&f>0;)f--;for(;c[m]==null&&m<je-1;)m++;return[f,m]}function vu(){if(je>0){let c=x.some(f=>f._focus)&&rt!=Ot.alpha;c&&(h.globalAlpha=rt=Ot.alpha),x.forEach((f,m)=>{if(m>0&&f.show&&(fo(m,!1),fo(m,!0),f._paths==null)){let g=rt;rt!=f.alpha&&(h.globalAlpha=rt=f.alpha);let v=s==2?[0,e[m][0].length-1]:gu(e[m]);f._paths=f.paths(r,m,v[0],v[1]),rt!=g&&(h.globalAlpha=rt=g)}}),x.forEach((f,m)=>{if(m>0&&f.show){let g=rt;rt!=f.alpha&&(h.globalAlpha=rt=f.alpha),f._paths!=null&&ho(m,!1);{let v=f._paths!=null?f._paths.gaps:null,y=f.points.show(r,m,Ue,He,v),E=f.points.filter(r,m,y,v);(y||E)&&(f.points._paths=f.points.paths(r,m,Ue,He,E),ho(m,!0))}rt!=g&&(h.globalAlpha=rt=g),Ge("drawSeries",m)}}),c&&(h.globalAlpha=rt=1)}}function fo(c,f){let m=f?x[c].points:x[c];m._stroke=m.stroke(r,c),m._fill=m.fill(r,c)}function ho(c,f){let m=f?x[c].points:x[c],{stroke:g,fill:v,clip:y,flags:E,_stroke:R=m._stroke,_fill:L=m._fill,_width:I=m.width}=m._paths;I=pe(I*ae,3);let F=null,O=I%2/2;f&&L==null&&(L=I>0?"#fff":R);let Q=m.pxAlign==1&&O>0;if(Q&&h.translate(O,O),!f){let oe=ot-I/2,se=pt-I/2,te=tt+I,$=St+I;F=new Path2D,F.rect(oe,se,te,$)}f?Gs(R,I,m.dash,m.cap,L,g,v,E,y):bu(c,R,I,m.dash,m.cap,L,g,v,E,F,y),Q&&h.translate(-O,-O)}function bu(c,f,m,g,v,y,E,R,L,I,F){let O=!1;L!=0&&z.forEach((Q,oe)=>{if(Q.series[0]==c){let se=x[Q.series[1]],te=e[Q.series[1]],$=(se._paths||dn).band;Zt($)&&($=Q.dir==1?$[0]:$[1]);let G,ye=null;se.show&&$&&pf(te,Ue,He)?(ye=Q.fill(r,oe)||y,G=se._paths.clip):$=null,Gs(f,m,g,v,ye,E,R,L,I,F,G,$),O=!0}}),O||Gs(f,m,g,v,y,E,R,L,I,F)}let mo=Yr|_i;function Gs(c,f,m,g,v,y,E,R,L,I,F,O){lo(c,f,m,g,v),(L||I||O)&&(h.save(),L&&h.clip(L),I&&h.clip(I)),O?(R&mo)==mo?(h.clip(O),F&&h.clip(F),Ln(v,E),Rn(c,y,f)):R&_i?(Ln(v,E),h.clip(O),Rn(c,y,f)):R&Yr&&(h.save(),h.clip(O),F&&h.clip(F),Ln(v,E),h.restore(),Rn(c,y,f)):(Ln(v,E),Rn(c,y,f)),(L||I||O)&&h.restore()}function Rn(c,f,m){m>0&&(f instanceof Map?f.forEach((g,v)=>{h.strokeStyle=Tn=v,h.stroke(g)}):f!=null&&c&&h.stroke(f))}function Ln(c,f){f instanceof Map?f.forEach((m,g)=>{h.fillStyle=Lr=g,h.fill(m)}):f!=null&&c&&h.fill(f)}function yu(c,f,m,g){let v=A[c],y;if(g<=0)y=[0,0];else{let E=v._space=v.space(r,c,f,m,g),R=v._incrs=v.incrs(r,c,f,m,g,E);y=Nh(f,m,R,g,E)}return v._found=y}function Ws(c,f,m,g,v,y,E,R,L,I){let F=E%2/2;w==1&&h.translate(F,F),lo(R,E,L,I,R),h.beginPath();let O,Q,oe,se,te=v+(g==0||g==3?-y:y);m==0?(Q=v,se=te):(O=v,oe=te);for(let $=0;$<c.length;$++)f[$]!=null&&(m==0?O=oe=c[$]:Q=se=c[$],h.moveTo(O,Q),h.lineTo(oe,se));h.stroke(),w==1&&h.translate(-F,-F)}function _u(c){let f=!0;return A.forEach((m,g)=>{if(!m.show)return;let v=M[m.scale];if(v.min==null){m._show&&(f=!1,m._show=!1,Pr(!1));return}else m._show||(f=!1,m._show=!0,Pr(!1));let y=m.side,E=y%2,{min:R,max:L}=v,[I,F]=yu(g,R,L,E==0?Z:C);if(F==0)return;let O=v.distr==2,Q=m._splits=m.splits(r,g,R,L,I,F,O),oe=v.distr==2?Q.map(G=>At[G]):Q,se=v.distr==2?At[Q[1]]-At[Q[0]]:I,te=m._values=m.values(r,m.filter(r,oe,g,F,se),g,F,se);m._rotate=y==2?m.rotate(r,te,g,F):0;let $=m._size;m._size=xt(m.size(r,te,g,c)),$!=null&&m._size!=$&&(f=!1)}),f}function wu(c){let f=!0;return oo.forEach((m,g)=>{let v=m(r,g,lr,c);v!=Xt[g]&&(f=!1),Xt[g]=v}),f}function xu(){for(let c=0;c<A.length;c++){let f=A[c];if(!f.show||!f._show)continue;let m=f.side,g=m%2,v,y,E=f.stroke(r,c),R=m==0||m==3?-1:1,[L,I]=f._found;if(f.label!=null){let Qe=f.labelGap*R,ct=Ne((f._lpos+Qe)*ae);co(f.labelFont[0],E,"center",m==2?"top":qo),h.save(),g==1?(v=y=0,h.translate(ct,Ne(pt+St/2)),h.rotate((m==3?-Gn:Gn)/2)):(v=Ne(ot+tt/2),y=ct);let fr=Na(f.label)?f.label(r,c,L,I):f.label;h.fillText(fr,v,y),h.restore()}if(I==0)continue;let F=M[f.scale],O=g==0?tt:St,Q=g==0?ot:pt,oe=f._splits,se=F.distr==2?oe.map(Qe=>At[Qe]):oe,te=F.distr==2?At[oe[1]]-At[oe[0]]:L,$=f.ticks,G=f.border,ye=$.show?$.size:0,Ae=Ne(ye*ae),We=Ne((f.alignTo==2?f._size-ye-f.gap:f.gap)*ae),fe=f._rotate*-Gn/180,Te=S(f._pos*ae),at=(Ae+We)*R,Ke=Te+at;y=g==0?Ke:0,v=g==1?Ke:0;let bt=f.font[0],Tt=f.align==1?Vr:f.align==2?oi:fe>0?Vr:fe<0?oi:g==0?"center":m==3?oi:Vr,Ut=fe||g==1?"middle":m==2?"top":qo;co(bt,E,Tt,Ut);let lt=f.font[1]*f.lineGap,yt=oe.map(Qe=>S(a(Qe,F,O,Q))),Rt=f._values;for(let Qe=0;Qe<Rt.length;Qe++){let ct=Rt[Qe];if(ct!=null){g==0?v=yt[Qe]:y=yt[Qe],ct=""+ct;let fr=ct.indexOf(`
`)==-1?[ct]:ct.split(/\n/gm);for(let Je=0;Je<fr.length;Je++){let Fo=fr[Je];fe?(h.save(),h.translate(v,y+Je*lt),h.rotate(fe),h.fillText(Fo,0,0),h.restore()):h.fillText(Fo,v,y+Je*lt)}}}$.show&&Ws(yt,$.filter(r,se,c,I,te),g,m,Te,Ae,pe($.width*ae,3),$.stroke(r,c),$.dash,$.cap);let Ht=f.grid;Ht.show&&Ws(yt,Ht.filter(r,se,c,I,te),g,g==0?2:1,g==0?pt:ot,g==0?St:tt,pe(Ht.width*ae,3),Ht.stroke(r,c),Ht.dash,Ht.cap),G.show&&Ws([Te],[1],g==0?1:0,g==0?1:2,g==1?pt:ot,g==1?St:tt,pe(G.width*ae,3),G.stroke(r,c),G.dash,G.cap)}Ge("drawAxes")}function Pr(c){x.forEach((f,m)=>{m>0&&(f._paths=null,c&&(s==1?(f.min=null,f.max=null):f.facets.forEach(g=>{g.min=null,g.max=null})))})}let Pn=!1,zs=!1,tn=[];function Eu(){zs=!1;for(let c=0;c<tn.length;c++)Ge(...tn[c]);tn.length=0}function kr(){Pn||(Lf(po),Pn=!0)}function Mu(c,f=!1){Pn=!0,zs=f,c(r),po(),f&&tn.length>0&&queueMicrotask(Eu)}r.batch=Mu;function po(){if(ks&&(pu(),ks=!1),Mr&&(lu(),Mr=!1),Mn){if(_e(b,Vr,ge),_e(b,"top",Oe),_e(b,un,Z),_e(b,fn,C),_e(_,Vr,ge),_e(_,"top",Oe),_e(_,un,Z),_e(_,fn,C),_e(p,un,Gt),_e(p,fn,nr),d.width=Ne(Gt*ae),d.height=Ne(nr*ae),A.forEach(({_el:c,_show:f,_size:m,_pos:g,side:v})=>{if(c!=null)if(f){let y=v===3||v===0?m:0,E=v%2==1;_e(c,E?"left":"top",g-y),_e(c,E?"width":"height",m),_e(c,E?"top":"left",E?Oe:ge),_e(c,E?"height":"width",E?C:Z),pi(c,pr)}else ft(c,pr)}),Tn=Lr=Cs=Ns=Ds=Us=Hs=Vs=Os=null,rt=1,sn(!0),ge!=Er||Oe!=sr||Z!=Ct||C!=ir){Pr(!1);let c=Z/Ct,f=C/ir;if(Xe&&!or&&B.left>=0){B.left*=c,B.top*=f,Ir&&Vt(Ir,Ne(B.left),0,Z,C),Fr&&Vt(Fr,0,Ne(B.top),Z,C);for(let m=0;m<vt.length;m++){let g=vt[m];g!=null&&(Tr[m]*=c,Rr[m]*=f,Vt(g,xt(Tr[m]),xt(Rr[m]),Z,C))}}if(be.show&&!Sn&&be.left>=0&&be.width>0){be.left*=c,be.width*=c,be.top*=f,be.height*=f;for(let m in Ks)_e(Nr,m,be[m])}Er=ge,sr=Oe,Ct=Z,ir=C}Ge("setSize"),Mn=!1}Gt>0&&nr>0&&(h.clearRect(0,0,d.width,d.height),Ge("drawClear"),V.forEach(c=>c()),Ge("draw")),be.show&&Sn&&(kn(be),Sn=!1),Xe&&or&&(ur(null,!0,!1),or=!1),ee.show&&ee.live&&gt&&(Xs(),gt=!1),l||(l=!0,r.status=1,Ge("ready")),en=!1,Pn=!1}r.redraw=(c,f)=>{Mr=f||!1,c!==!1?Kt(k,P.min,P.max):kr()};function js(c,f){let m=M[c];if(m.from==null){if(je==0){let g=m.range(r,f.min,f.max,c);f.min=g[0],f.max=g[1]}if(f.min>f.max){let g=f.min;f.min=f.max,f.max=g}if(je>1&&f.min!=null&&f.max!=null&&f.max-f.min<1e-16)return;c==k&&m.distr==2&&je>0&&(f.min=Pt(f.min,e[0]),f.max=Pt(f.max,e[0]),f.min==f.max&&f.max++),H[c]=f,ks=!0,kr()}}r.setScale=js;let Ys,qs,Ir,Fr,go,vo,Cr,Or,bo,yo,ve,Ee,$t=!1,Ye=B.drag,Ve=Ye.x,Be=Ye.y;Xe&&(B.x&&(Ys=wt(Ju,_)),B.y&&(qs=wt(Zu,_)),P.ori==0?(Ir=Ys,Fr=qs):(Ir=qs,Fr=Ys),ve=B.left,Ee=B.top);let be=r.select=Fe({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Nr=be.show?wt(Qu,be.over?_:b):null;function kn(c,f){if(be.show){for(let m in c)be[m]=c[m],m in Ks&&_e(Nr,m,c[m]);f!==!1&&Ge("setSelect")}}r.setSelect=kn;function Su(c){if(x[c].show)Ce&&pi(Se[c],pr);else if(Ce&&ft(Se[c],pr),Xe){let m=Ar?vt[0]:vt[c];m!=null&&Vt(m,-10,-10,Z,C)}}function Kt(c,f,m){js(c,{min:f,max:m})}function Nt(c,f,m,g){f.focus!=null&&Pu(c),f.show!=null&&x.forEach((v,y)=>{y>0&&(c==y||c==null)&&(v.show=f.show,Su(y),s==2?(Kt(v.facets[0].scale,null,null),Kt(v.facets[1].scale,null,null)):Kt(v.scale,null,null),kr())}),m!==!1&&Ge("setSeries",c,f),g&&on("setSeries",r,c,f)}r.setSeries=Nt;function Au(c,f){Fe(z[c],f)}function Tu(c,f){c.fill=re(c.fill||null),c.dir=ie(c.dir,-1),f=f??z.length,z.splice(f,0,c)}function Ru(c){c==null?z.length=0:z.splice(c,1)}r.addBand=Tu,r.setBand=Au,r.delBand=Ru;function Lu(c,f){x[c].alpha=f,Xe&&vt[c]!=null&&(vt[c].style.opacity=f),Ce&&Se[c]&&(Se[c].style.opacity=f)}let Wt,Qt,cr,Dr={focus:!0};function Pu(c){if(c!=cr){let f=c==null,m=Ot.alpha!=1;x.forEach((g,v)=>{if(s==1||v>0){let y=f||v==0||v==c;g._focus=f?null:y,m&&Lu(v,y?1:Ot.alpha)}}),cr=c,m&&kr()}}Ce&&Sr&&$e(Qo,le,c=>{B._lock||(ar(c),cr!=null&&Nt(null,Dr,!0,ke.setSeries))});function Dt(c,f,m){let g=M[f];m&&(c=c/ae-(g.ori==1?Oe:ge));let v=Z;g.ori==1&&(v=C,c=v-c),g.dir==-1&&(c=v-c);let y=g._min,E=g._max,R=c/v,L=y+(E-y)*R,I=g.distr;return I==3?Wr(10,L):I==4?vf(L,g.asinh):I==100?g.bwd(L):L}function ku(c,f){let m=Dt(c,k,f);return Pt(m,e[0],Ue,He)}r.valToIdx=c=>Pt(c,e[0]),r.posToIdx=ku,r.posToVal=Dt,r.valToPos=(c,f,m)=>M[f].ori==0?i(c,M[f],m?tt:Z,m?ot:0):o(c,M[f],m?St:C,m?pt:0),r.setCursor=(c,f,m)=>{ve=c.left,Ee=c.top,ur(null,f,m)};function _o(c,f){_e(Nr,Vr,be.left=c),_e(Nr,un,be.width=f)}function wo(c,f){_e(Nr,"top",be.top=c),_e(Nr,fn,be.height=f)}let rn=P.ori==0?_o:wo,nn=P.ori==1?_o:wo;function Iu(){if(Ce&&ee.live)for(let c=s==2?1:0;c<x.length;c++){if(c==0&&dt)continue;let f=ee.values[c],m=0;for(let g in f)Ft[c][m++].firstChild.nodeValue=f[g]}}function Xs(c,f){if(c!=null&&(c.idxs?c.idxs.forEach((m,g)=>{ue[g]=m}):wf(c.idx)||ue.fill(c.idx),ee.idx=ue[0]),Ce&&ee.live){for(let m=0;m<x.length;m++)(m>0||s==1&&!dt)&&Fu(m,ue[m]);Iu()}gt=!1,f!==!1&&Ge("setLegend")}r.setLegend=Xs;function Fu(c,f){let m=x[c],g=c==0&&K==2?At:e[c],v;dt?v=m.values(r,c,f)??qt:(v=m.value(r,f==null?null:g[f],c,f),v=v==null?qt:{_:v}),ee.values[c]=v}function ur(c,f,m){bo=ve,yo=Ee,[ve,Ee]=B.move(r,ve,Ee),B.left=ve,B.top=Ee,Xe&&(Ir&&Vt(Ir,Ne(ve),0,Z,C),Fr&&Vt(Fr,0,Ne(Ee),Z,C));let g,v=Ue>He;Wt=de,Qt=null;let y=P.ori==0?Z:C,E=P.ori==1?Z:C;if(ve<0||je==0||v){g=B.idx=null;for(let R=0;R<x.length;R++){let L=vt[R];L!=null&&Vt(L,-10,-10,Z,C)}Sr&&Nt(null,Dr,!0,c==null&&ke.setSeries),ee.live&&(ue.fill(g),gt=!0)}else{let R,L,I;s==1&&(R=P.ori==0?ve:Ee,L=Dt(R,k),g=B.idx=Pt(L,e[0],Ue,He),I=D(e[0][g],P,y,0));let F=-10,O=-10,Q=0,oe=0,se=!0,te="",$="";for(let G=s==2?1:0;G<x.length;G++){let ye=x[G],Ae=ue[G],We=Ae==null?null:s==1?e[G][Ae]:e[G][1][Ae],fe=B.dataIdx(r,G,g,L),Te=fe==null?null:s==1?e[G][fe]:e[G][1][fe];if(gt=gt||Te!=We||fe!=Ae,ue[G]=fe,G>0&&ye.show){let at=fe==null?-10:fe==g?I:D(s==1?e[0][fe]:e[G][0][fe],P,y,0),Ke=Te==null?-10:q(Te,s==1?M[ye.scale]:M[ye.facets[1].scale],E,0);if(Sr&&Te!=null){let bt=P.ori==1?ve:Ee,Tt=De(Ot.dist(r,G,fe,Ke,bt));if(Tt<Wt){let Ut=Ot.bias;if(Ut!=0){let lt=Dt(bt,ye.scale),yt=Te>=0?1:-1,Rt=lt>=0?1:-1;Rt==yt&&(Rt==1?Ut==1?Te>=lt:Te<=lt:Ut==1?Te<=lt:Te>=lt)&&(Wt=Tt,Qt=G)}else Wt=Tt,Qt=G}}if(gt||Ar){let bt,Tt;P.ori==0?(bt=at,Tt=Ke):(bt=Ke,Tt=at);let Ut,lt,yt,Rt,Ht,Qe,ct=!0,fr=qe.bbox;if(fr!=null){ct=!1;let Je=fr(r,G);yt=Je.left,Rt=Je.top,Ut=Je.width,lt=Je.height}else yt=bt,Rt=Tt,Ut=lt=qe.size(r,G);if(Qe=qe.fill(r,G),Ht=qe.stroke(r,G),Ar)G==Qt&&Wt<=Ot.prox&&(F=yt,O=Rt,Q=Ut,oe=lt,se=ct,te=Qe,$=Ht);else{let Je=vt[G];Je!=null&&(Tr[G]=yt,Rr[G]=Rt,sa(Je,Ut,lt,ct),ra(Je,Qe,Ht),Vt(Je,xt(yt),xt(Rt),Z,C))}}}}if(Ar){let G=Ot.prox,ye=cr==null?Wt<=G:Wt>G||Qt!=cr;if(gt||ye){let Ae=vt[0];Ae!=null&&(Tr[0]=F,Rr[0]=O,sa(Ae,Q,oe,se),ra(Ae,te,$),Vt(Ae,xt(F),xt(O),Z,C))}}}if(be.show&&$t)if(c!=null){let[R,L]=ke.scales,[I,F]=ke.match,[O,Q]=c.cursor.sync.scales,oe=c.cursor.drag;if(Ve=oe._x,Be=oe._y,Ve||Be){let{left:se,top:te,width:$,height:G}=c.select,ye=c.scales[O].ori,Ae=c.posToVal,We,fe,Te,at,Ke,bt=R!=null&&I(R,O),Tt=L!=null&&F(L,Q);bt&&Ve?(ye==0?(We=se,fe=$):(We=te,fe=G),Te=M[R],at=D(Ae(We,O),Te,y,0),Ke=D(Ae(We+fe,O),Te,y,0),rn(kt(at,Ke),De(Ke-at))):rn(0,y),Tt&&Be?(ye==1?(We=se,fe=$):(We=te,fe=G),Te=M[L],at=q(Ae(We,Q),Te,E,0),Ke=q(Ae(We+fe,Q),Te,E,0),nn(kt(at,Ke),De(Ke-at))):nn(0,E)}else Qs()}else{let R=De(bo-go),L=De(yo-vo);if(P.ori==1){let Q=R;R=L,L=Q}Ve=Ye.x&&R>=Ye.dist,Be=Ye.y&&L>=Ye.dist;let I=Ye.uni;I!=null?Ve&&Be&&(Ve=R>=I,Be=L>=I,!Ve&&!Be&&(L>R?Be=!0:Ve=!0)):Ye.x&&Ye.y&&(Ve||Be)&&(Ve=Be=!0);let F,O;Ve&&(P.ori==0?(F=Cr,O=ve):(F=Or,O=Ee),rn(kt(F,O),De(O-F)),Be||nn(0,E)),Be&&(P.ori==1?(F=Cr,O=ve):(F=Or,O=Ee),nn(kt(F,O),De(O-F)),Ve||rn(0,y)),!Ve&&!Be&&(rn(0,0),nn(0,0))}if(Ye._x=Ve,Ye._y=Be,c==null){if(m){if(Io!=null){let[R,L]=ke.scales;ke.values[0]=R!=null?Dt(P.ori==0?ve:Ee,R):null,ke.values[1]=L!=null?Dt(P.ori==1?ve:Ee,L):null}on(ai,r,ve,Ee,Z,C,g)}if(Sr){let R=m&&ke.setSeries,L=Ot.prox;cr==null?Wt<=L&&Nt(Qt,Dr,!0,R):Wt>L?Nt(null,Dr,!0,R):Qt!=cr&&Nt(Qt,Dr,!0,R)}}gt&&(ee.idx=g,Xs()),f!==!1&&Ge("setCursor")}let Jt=null;Object.defineProperty(r,"rect",{get(){return Jt==null&&sn(!1),Jt}});function sn(c=!1){c?Jt=null:(Jt=_.getBoundingClientRect(),Ge("syncRect",Jt))}function xo(c,f,m,g,v,y,E){B._lock||$t&&c!=null&&c.movementX==0&&c.movementY==0||($s(c,f,m,g,v,y,E,!1,c!=null),c!=null?ur(null,!0,!0):ur(f,!0,!1))}function $s(c,f,m,g,v,y,E,R,L){if(Jt==null&&sn(!1),ar(c),c!=null)m=c.clientX-Jt.left,g=c.clientY-Jt.top;else{if(m<0||g<0){ve=-10,Ee=-10;return}let[I,F]=ke.scales,O=f.cursor.sync,[Q,oe]=O.values,[se,te]=O.scales,[$,G]=ke.match,ye=f.axes[0].side%2==1,Ae=P.ori==0?Z:C,We=P.ori==1?Z:C,fe=ye?y:v,Te=ye?v:y,at=ye?g:m,Ke=ye?m:g;if(se!=null?m=$(I,se)?a(Q,M[I],Ae,0):-10:m=Ae*(at/fe),te!=null?g=G(F,te)?a(oe,M[F],We,0):-10:g=We*(Ke/Te),P.ori==1){let bt=m;m=g,g=bt}}L&&(f==null||f.cursor.event.type==ai)&&((m<=1||m>=Z-1)&&(m=mr(m,Z)),(g<=1||g>=C-1)&&(g=mr(g,C))),R?(go=m,vo=g,[Cr,Or]=B.move(r,m,g)):(ve=m,Ee=g)}let Ks={width:0,height:0,left:0,top:0};function Qs(){kn(Ks,!1)}let Eo,Mo,So,Ao;function To(c,f,m,g,v,y,E){$t=!0,Ve=Be=Ye._x=Ye._y=!1,$s(c,f,m,g,v,y,E,!0,!1),c!=null&&($e(li,mi,Ro,!1),on($o,r,Cr,Or,Z,C,null));let{left:R,top:L,width:I,height:F}=be;Eo=R,Mo=L,So=I,Ao=F}function Ro(c,f,m,g,v,y,E){$t=Ye._x=Ye._y=!1,$s(c,f,m,g,v,y,E,!1,!0);let{left:R,top:L,width:I,height:F}=be,O=I>0||F>0,Q=Eo!=R||Mo!=L||So!=I||Ao!=F;if(O&&Q&&kn(be),Ye.setScale&&O&&Q){let oe=R,se=I,te=L,$=F;if(P.ori==1&&(oe=L,se=F,te=R,$=I),Ve&&Kt(k,Dt(oe,k),Dt(oe+se,k)),Be)for(let G in M){let ye=M[G];G!=k&&ye.from==null&&ye.min!=de&&Kt(G,Dt(te+$,G),Dt(te,G))}Qs()}else B.lock&&(B._lock=!B._lock,ur(f,!0,c!=null));c!=null&&(xr(li,mi),on(li,r,ve,Ee,Z,C,null))}function Cu(c,f,m,g,v,y,E){if(B._lock)return;ar(c);let R=$t;if($t){let L=!0,I=!0,F=10,O,Q;P.ori==0?(O=Ve,Q=Be):(O=Be,Q=Ve),O&&Q&&(L=ve<=F||ve>=Z-F,I=Ee<=F||Ee>=C-F),O&&L&&(ve=ve<Cr?0:Z),Q&&I&&(Ee=Ee<Or?0:C),ur(null,!0,!0),$t=!1}ve=-10,Ee=-10,ue.fill(null),ur(null,!0,!0),R&&($t=R)}function Lo(c,f,m,g,v,y,E){B._lock||(ar(c),Fs(),Qs(),c!=null&&on(Jo,r,ve,Ee,Z,C,null))}function Po(){A.forEach(Dh),Is(r.width,r.height,!0)}gr(Wn,Gr,Po);let Ur={};Ur.mousedown=To,Ur.mousemove=xo,Ur.mouseup=Ro,Ur.dblclick=Lo,Ur.setSeries=(c,f,m,g)=>{let v=ke.match[2];m=v(r,f,m),m!=-1&&Nt(m,g,!0,!1)},Xe&&($e($o,_,To),$e(ai,_,xo),$e(Ko,_,c=>{ar(c),sn(!1)}),$e(Qo,_,Cu),$e(Jo,_,Lo),wi.add(r),r.syncRect=sn);let In=r.hooks=t.hooks||{};function Ge(c,f,m){zs?tn.push([c,f,m]):c in In&&In[c].forEach(g=>{g.call(null,r,f,m)})}(t.plugins||[]).forEach(c=>{for(let f in c.hooks)In[f]=(In[f]||[]).concat(c.hooks[f])});let ko=(c,f,m)=>m,ke=Fe({key:null,setSeries:!1,filters:{pub:ca,sub:ca},scales:[k,x[1]?x[1].scale:null],match:[ua,ua,ko],values:[null,null]},B.sync);ke.match.length==2&&ke.match.push(ko),B.sync=ke;let Io=ke.key,Js=ol(Io);function on(c,f,m,g,v,y,E){ke.filters.pub(c,f,m,g,v,y,E)&&Js.pub(c,f,m,g,v,y,E)}Js.sub(r);function Ou(c,f,m,g,v,y,E){ke.filters.sub(c,f,m,g,v,y,E)&&Ur[c](null,f,m,g,v,y,E)}r.pub=Ou;function Nu(){Js.unsub(r),wi.delete(r),rr.clear(),gi(Wn,Gr,Po),u.remove(),le?.remove(),Ge("destroy")}r.destroy=Nu;function Zs(){Ge("init",t,e),ao(e||t.data,!1),H[k]?js(k,H[k]):Fs(),Sn=be.show&&(be.width>0||be.height>0),or=gt=!0,Is(t.width,t.height)}return x.forEach(io),A.forEach(du),n?n instanceof HTMLElement?(n.appendChild(u),Zs()):n(r,Zs):Zs(),r}ze.assign=Fe;ze.fmtNum=Ri;ze.rangeNum=zn;ze.rangeLog=qn;ze.rangeAsinh=Ai;ze.orient=br;ze.pxRatio=ae;ze.join=Rf;ze.fmtDate=Pi,ze.tzDate=Hf;ze.sync=ol;{ze.addGap=wh,ze.clipGaps=Kn;let t=ze.paths={points:hl};t.linear=dl,t.stepped=Mh,t.bars=Sh,t.spline=Th}var bl=96,Uh=8,es=["#2f8fef","#e8820c","#1fa367","#a45ee5","#e5484d","#12a5b8","#b58900","#d6409f","#6e7fd9","#7a8b3a"];function Di(t,e){let[n,r]=[0,t.times.length];for(;n<r;){let s=n+r>>1;t.times[s]<=e+1e-4?n=s+1:r=s}return n===0?null:t.values[n-1]}var tr=class{constructor(e,n){this.container=e;this.seek=n;this.set([]),new ResizeObserver(()=>this.resize()).observe(e)}container;seek;charts=[];time=0;set(e){for(let{plot:n}of this.charts)n.destroy();this.container.replaceChildren(),this.charts=e.map((n,r)=>this.chart(n,r))}redraw(){for(let{plot:e}of this.charts)e.redraw(!1)}show(e,n){this.time=e,n.length===this.charts.length&&n.every((s,i)=>s===this.charts[i].curve)||this.set(n);for(let s of this.charts){let i=Di(s.curve,e);s.value.textContent=Gh(s.curve,i);let o=s.curve.times.at(-1);s.drawnTime!==o&&(s.drawnTime=o,s.plot.setData([s.curve.times,s.curve.values])),this.moveCursor(s)}}moveCursor({plot:e,cursor:n}){let r=e.valToPos(this.time,"x");n.hidden=!(r>=0&&r<=e.over.clientWidth),n.style.transform=`translateX(${r}px)`}chart(e,n){let r=document.createElement("figure"),s=document.createElement("figcaption"),i=document.createElement("button"),o=document.createElement("output");i.textContent=e.name.replaceAll("_"," "),i.title=`${e.name}: fold or unfold`;let a=d=>{r.classList.toggle("folded",d),i.setAttribute("aria-expanded",String(!d))};i.addEventListener("click",()=>a(!r.classList.contains("folded"))),a(n>=Uh),i.style.setProperty("--mark",es[n%es.length]),s.append(i,o),r.append(s),this.container.append(r);let l=new ze(this.options(e,es[n%es.length]),[e.times,e.values],r);l.over.addEventListener("click",d=>this.seek(l.posToVal(d.offsetX,"x")));let u=document.createElement("i");return u.className="cursor",l.over.append(u),{curve:e,plot:l,cursor:u,value:o,drawnTime:e.times.at(-1)}}options({names:e,isFraction:n},r){let s=o=>getComputedStyle(this.container).getPropertyValue(o).trim(),i=()=>({stroke:()=>s("--soft"),grid:{stroke:()=>s("--line"),width:1},ticks:{show:!1},font:"10px system-ui, sans-serif"});return{width:Math.max(120,this.container.clientWidth-20),height:bl,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:Hh(e,n)}},axes:[{...i(),size:20,gap:2},{...i(),size:44,gap:2,space:12,values:(o,a,l,u,d)=>a.map(h=>Vh(h,d)),...e?.length?{incrs:[1,2,5,10]}:{}}],series:[{},{stroke:r,width:1.5,spanGaps:!1,paths:e?.length?ze.paths.stepped({align:1}):void 0,points:{show:!0,size:4,fill:r,filter:Bh}}]}}resize(){let e=Math.max(120,this.container.clientWidth-20);for(let n of this.charts)n.plot.setSize({width:e,height:bl}),this.moveCursor(n)}};function Hh(t,e){return t?.length?[0,t.length]:e?[0,1]:(n,r,s)=>{if(r===null||s===null)return[0,1];let i=s-r<1e-5*Math.max(Math.abs(r),Math.abs(s),1e-6);if(i&&r>=0)return[0,s>0?2*s:1];let o=i?Math.max(.5,.1*Math.abs(s)):.08*(s-r);return[r-o,s+o]}}function Vh(t,e){let n=[0,1,2,3,4,5].find(r=>Math.abs(e*10**r-Math.round(e*10**r))<1e-6)??9;return Math.abs(t)>=1e5||n>5?t===0?"0":t.toExponential(1):String(Number(t.toFixed(n)))}function Bh(t,e){let n=t.data[e],r=s=>n[s]===null||n[s]===void 0;return[...n.keys()].filter(s=>!r(s)&&r(s-1)&&r(s+1))}function Gh({unit:t,names:e},n){return n===null?"–":e?.length?e[n-1]??"none yet":`${Wh(n)} ${t==="1"?"":t}`.trim()}function Wh(t){let e=Math.abs(t);return t===0?"0":e>=1e5||e<.001?t.toExponential(2):t.toPrecision(4)}var Ui=3e3,zh=16,ts=class{constructor(e){this.request=e;let n=N("topic");n.addEventListener("change",()=>{this.add(n.value),n.value=""})}request;cards=new Map;types={};list(e){this.types=Object.fromEntries(e);let n=N("topic"),r=e.map(([s,i])=>new Option(`${s}  (${i.replace("/msg/","/")})`,s));n.replaceChildren(new Option("Show a topic…",""),...r),N("topics-box").hidden=!e.length}showMessage(e){this.cards.get(e.name)?.showMessage(e)}show(e){for(let n of this.cards.values())n.show(e)}redrawCurves(){for(let e of this.cards.values())e.curves.redraw()}add(e){if(!e||this.cards.has(e)||this.cards.size>=zh)return;let n=new Hi(e,this.types[e]??"",()=>{this.cards.delete(e),this.request([...this.cards.keys()])});this.cards.set(e,n),N("topics").append(n.box),this.request([...this.cards.keys()])}},Hi=class{box=j("div","","topic");curves;rows=new Map;samples=new Map;selection=new Set;table=j("div","","fields");note=j("p","No message yet. A topic without a subscriber may have none.","none");constructor(e,n,r){let[s,i,o]=[j("h3"),j("button","×"),j("div")];i.title=`Hide ${e}`,i.setAttribute("aria-label",i.title),i.addEventListener("click",()=>{this.box.remove(),r()});let a=j("span",e);a.title=n,s.append(a,i),this.box.append(s,this.note,this.table,o),this.curves=new tr(o,()=>{})}showMessage({time:e,fields:n,is_cut:r}){this.note.textContent=r?"The first fields of the message:":"",this.note.hidden=!r;for(let[s,i]of n){let o=this.samples.size===0;typeof i=="number"&&this.store(s,e,i),o&&this.samples.size&&this.selection.add(s);let a=this.rows.get(s)??this.row(s,typeof i=="number");a.value.textContent=typeof i=="number"?String(Number(i.toPrecision(6))):i??"–"}this.mark()}show(e){let n=[...this.samples].filter(([r])=>this.selection.has(r));this.curves.show(e,n.map(([,r])=>r))}store(e,n,r){let s=this.samples.get(e);s||this.samples.set(e,s={name:e,unit:"",times:[],values:[]}),!(n<=(s.times.at(-1)??-1))&&(s.times.push(n),s.values.push(r),!(s.times.length<=Ui)&&(s.times.splice(0,Ui/2),s.values.splice(0,Ui/2)))}row(e,n){let[r,s]=[j(n?"button":"div","","field"),j("output")];r.append(j("span",e),s),n&&(r.title="Show or hide its curve",r.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.mark()})),this.table.append(r);let i={row:r,value:s};return this.rows.set(e,i),i}mark(){for(let[e,{row:n}]of this.rows)n instanceof HTMLButtonElement&&n.setAttribute("aria-pressed",String(this.selection.has(e)))}};var Kr=16,jh=100,Yh=640,Vi=class{constructor(e,n,r,s){this.socket=e;this.pack=n;this.earlyEvents=r;this.isServerDrawn=s;e.onclose=()=>this.end("The simulation has ended.")}socket;pack;earlyEvents;isServerDrawn;pilot=new Un((e,n)=>{this.send(e),n&&this.page?.picture.skipPauses()});topics=new ts(e=>this.send({type:"topics",names:e}));page=null;stream=null;lastRequest="";imageNumbers=[];allowsReset=!1;begin(e,n){this.page=e,this.stream=n;for(let r of this.earlyEvents)this.receive(r);this.socket.onmessage=r=>this.receive(r),this.subscribe(e.switches.pictures)}subscribe(e){let n=e?this.pack.head.cameras.map(({name:r})=>r):[];this.send({type:"images",cameras:n,rate:10,width:this.page?.picture.pictureWidth()})}requestView({worldFromCamera:e,camera:n,intrinsics:r}){if(!this.isServerDrawn)return;let s=Math.min(1,Yh/r.width),[i,o]=[r.width,r.height].map(h=>Math.round(s*h)),a=Co(e).map(h=>Math.round(1e4*h)/1e4),l=2*Math.atan(r.height/2/r.fy),u={type:"view",camera:n?.name??null,pose:a,width:i,height:o,fovy:l},d=JSON.stringify(u);d!==this.lastRequest&&this.send(u),this.lastRequest=d}control(e,n){this.send({type:"control",action:e,...n===void 0?{}:{speed:n}})}handlePilotKey(e){return this.pilot.handlePilotKey(e)}helpGroups(){return{Pilot:this.pilot.help()}}send(e){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}receive(e){let{page:n,stream:r}=this;if(!n||!r)return;if(typeof e.data=="string")return this.handleMessage(JSON.parse(e.data),n,r);let s=new DataView(e.data),[i,o]=[s.getUint8(0),s.getUint8(1)];i===0&&location.reload(),i===1&&r.push(s.getFloat64(8,!0),new Float32Array(e.data,Kr)),i===2&&this.showImage(o,e.data.slice(Kr),n,r),i===4&&r.setSand(o,new Float32Array(e.data,Kr)),i===5&&this.addMedium(e.data.slice(Kr),n,r),i===3&&this.isServerDrawn&&this.showView(e.data.slice(Kr))}async addMedium(e,n,r){let s=await ln(new Uint8Array(e));n.picture.media.add(s,s.head.optics),r.version+=1}handleMessage(e,n,r){if(e.type==="state")n.setState(e.paused,e.speed),this.allowsReset=e.resets,this.pilot.enable(e),n.views.follow(e.vehicle),n.keyboard.showHelp();else if(e.type==="levels")r.setLevels(e.levels);else if(e.type==="samples")for(let s of e.samples)r.sample(...s);else e.type==="readings"?r.version+=Number(n.quantities.setReadings(e.readings)):e.type==="topics"?this.topics.list(e.topics):e.type==="topic"?this.topics.showMessage(e):e.type==="markers"?r.setMarkers(e.markers):e.type==="end"&&this.end(e.why)}async showImage(e,n,r,s){let i=(this.imageNumbers[e]??0)+1;this.imageNumbers[e]=i;let o=await createImageBitmap(new Blob([n],{type:"image/jpeg"}));if(this.imageNumbers[e]!==i)return o.close();r.picture.show(e,o);let{end:a}=s;setTimeout(()=>{s.end===a&&(s.version+=1)},jh)}showView(e){let n=N("stream");n.hidden=!1,qh(n,e)}end(e){N("message").textContent=e,this.page&&(this.page.isPlaying=!1)}};function qh(t,e){let n=t.src;t.src=URL.createObjectURL(new Blob([e],{type:"image/jpeg"})),n&&URL.revokeObjectURL(n)}function yl(t){let e=location.protocol==="https:"?"wss:":"ws:",n=new WebSocket(`${e}//${location.host}/socket${location.search}`);return n.binaryType="arraybuffer",new Promise((r,s)=>{let i=[],o=!1;n.onerror=n.onclose=()=>s(new Error("The simulation cannot be reached.")),n.onmessage=a=>{let{data:l}=a;if(o||typeof l=="string"||new DataView(l).getUint8(0)!==0){i.push(a);return}o=!0,ln(new Uint8Array(l.slice(Kr))).then(u=>r(new Vi(n,u,i,t)),s)}})}var Xh=["clear","dusk","cloudy"],rs=.03,ns=class{constructor(e){this.page=e;let n=N("view");document.addEventListener("keydown",r=>this.onKeyDown(r)),n.addEventListener("keydown",r=>this.turnView(r)),n.addEventListener("pointerdown",r=>{if(r.target.closest("button, .stick"))return;n.setPointerCapture(r.pointerId);let s=r.button!==0||r.shiftKey;this.dragState={x:r.clientX,y:r.clientY,isPan:s}}),n.addEventListener("pointermove",r=>this.drag(r)),n.addEventListener("pointerup",()=>this.dragState=null),n.addEventListener("pointercancel",()=>this.dragState=null),n.addEventListener("contextmenu",r=>r.preventDefault()),n.addEventListener("wheel",r=>{r.preventDefault(),e.views.zoom(Math.exp(.001*r.deltaY))},{passive:!1}),this.showHelp()}page;dragState=null;showHelp(){Wo(this.groups())}drag(e){if(!this.dragState)return;let n=N("view").clientHeight,[r,s]=[e.clientX-this.dragState.x,e.clientY-this.dragState.y];this.page.views.drag(r/n,s/n,this.dragState.isPan),Object.assign(this.dragState,{x:e.clientX,y:e.clientY})}turnView(e){let r={ArrowLeft:[rs,0],ArrowRight:[-rs,0],ArrowUp:[0,rs],ArrowDown:[0,-rs]}[e.key];!r||e.ctrlKey||e.altKey||e.metaKey||(e.preventDefault(),e.stopPropagation(),this.page.views.drag(r[0],r[1],e.shiftKey))}onKeyDown(e){let{page:n}=this;if(e.ctrlKey||e.altKey||e.metaKey)return;let r=e.target;if((r instanceof HTMLSelectElement||r instanceof HTMLInputElement)&&!/^[a-z?]$/.test(e.key)||e.key===" "&&r instanceof HTMLButtonElement||/^(Home|End)$/.test(e.key)&&N("help").contains(r)||n.connection?.handlePilotKey(e))return;let i=e.shiftKey?e.key.toLowerCase():e.key,o=this.actions()[i];o&&(e.preventDefault(),o())}actions(){let{page:e}=this,n=s=>()=>{let i=e.player.levels.findIndex(({trial:o,level:a})=>o===e.player.trial&&a.end>e.time);e.go(Math.max(0,(i<0?e.player.levels.length-1:i)+s))},r=s=>()=>{e.switches.sun=Xh[s],e.draw()};return{" ":()=>e.play(),",":()=>e.step(-1),".":()=>e.step(1),ArrowLeft:()=>e.seek(e.time-1),ArrowRight:()=>e.seek(e.time+1),Home:()=>e.seek(e.player.start),End:()=>e.seek(e.player.end),"[":n(-1),"]":n(1),"<":()=>e.changeSpeed(-1),">":()=>e.changeSpeed(1),o:()=>e.show("orbit"),b:()=>e.show("chase"),v:()=>e.show("camera"),m:()=>e.show("map"),p:()=>e.show("file"),z:()=>e.toggle("state"),h:()=>e.views.restoreInitial(),k:()=>e.views.toggleFollowing(),r:()=>e.reset(),"+":()=>e.views.zoom(.9),"=":()=>e.views.zoom(.9),"-":()=>e.views.zoom(1.1),x:()=>e.toggle("clear"),c:()=>e.toggle("pictures"),f:()=>e.toggle("frames"),l:()=>e.toggle("labels"),t:()=>e.toggle("trails"),y:()=>e.clearTrails(),s:()=>e.toggle("sonars"),n:()=>e.toggleTheme(),1:r(0),2:r(1),3:r(2),"?":Dn}}groups(){let{page:e}=this,n=e.connection?"reset vehicles and objects":"start of the level",r=[{keys:", .",action:"one row back, forward"},{keys:"← →",action:"one second back, forward (in the view: rotate it)"},{keys:"[ ]",action:"previous, next level"},{keys:"Home End",action:"start, end"}],s={Time:[{keys:"space",action:"play, pause"},...e.connection?[{keys:".",action:"one step"}]:r,{keys:"< >",action:"slower, faster"},...e.connection&&!e.connection.allowsReset?[]:[{keys:"r",action:n}]],View:[{keys:"o b v m",action:"orbit, behind the vehicle, next camera, map from above"},...e.pack.head.file_view?[{keys:"p",action:"the camera of the scene file"}]:[],{keys:"k",action:"orbit follows the vehicle, or stays"},{keys:"arrows, drag",action:"rotate; with Shift or the right button: move"},{keys:"+ -, wheel",action:"nearer, farther"},{keys:"h",action:"first view"},{keys:"x",action:"clear water, or the scene's fog"},{keys:"1 2 3",action:"clear sky, dusk, cloudy"}],Shown:[{keys:"c",action:"images of the cameras"},{keys:"z",action:"state of the vehicle; a click on a number draws its curve"},{keys:"f l",action:"frames, names"},{keys:"t y",action:"trails; restart them"},{keys:"s",action:"beams and fans of sonars"},{keys:"n",action:"light or dark colours"},{keys:"?",action:"these keys"}]};if(!e.connection)return s;let i=e.connection.pilot;for(let o of Object.values(s).flat())o.keys=o.keys.split(" ").map(a=>i.isReserved(a)?`Shift+${a}`:a).join(" ");return{...s,...e.connection.helpGroups()}}};function wl({water:t,view:e}){let n=t.media?.[0];return n?Math.min(...n.absorption.map((s,i)=>s+n.scattering[i]))*Math.hypot(...e.at.map((s,i)=>s-e.pose[i]))>3:!0}var ss=class{entries=[];clearMedium;constructor(e){let{media:n,clear:r}=e.head.water;for(let s of n??[])this.add(e,s);this.clearMedium=r?_l(e,r):null}add(e,n){this.entries.length>=64&&this.entries.splice(1,1),this.entries.push(_l(e,n))}mediumAt(e){if(!this.entries.length)return null;let n=e.signal("beam_attenuation"),r=n===void 0?this.entries[0]:$h(this.entries,n),s=e.signal("exposure_level");if(s===void 0)return r;let i=2**s/r.exposure;return{...r,exposure:2**s,clear_exposure:i*r.clear_exposure}}clearOptics(e){return e&&this.clearMedium&&{...this.clearMedium,exposure:e.clear_exposure}}};function $h(t,e){let n=t.map(({absorption:r,scattering:s})=>Math.abs(r[1]+s[1]-e));return t[n.lastIndexOf(Math.min(...n))]}function _l(t,e){let n=t.numbers(e.transform.values);return{...e,transform:{...e.transform,values:n}}}var xl=200,El=5,Bi=6e3,Kh=1200,Gi=180/Math.PI,is=class{constructor(e,n){this.head=e;this.rays=n}head;rays;histories=new Map;readings=[];storeTime=-1/0;trial=-1;vehicle=0;setReadings(e){let n=JSON.stringify(e)!==JSON.stringify(this.readings);return this.readings=e,n}compute(e,n,r){this.vehicle=r;let s=this.readings.map(([i,o,a])=>({name:i,unit:o,value:a}));return[...this.motionQuantities(e,n),...s]}store(e,n){if(e<this.storeTime&&this.histories.clear(),!(e>=this.storeTime&&e<this.storeTime+1/El)){this.storeTime=e;for(let{name:r,unit:s,value:i}of n){let o=this.historyOf(r,s);o.times.push(e),o.values.push(i),!(o.times.length<=Bi)&&(o.times.splice(0,Bi/2),o.values.splice(0,Bi/2))}}}history({name:e,unit:n},r){if(r.isLive)return this.historyOf(e,n);r.trial!==this.trial&&this.histories.clear(),this.trial=r.trial;let s=this.histories.get(e);if(s)return s;let i=this.historyOf(e,n),o=r.end-r.start,a=Math.max(2,Math.min(Kh,Math.ceil(o*El)));for(let l=0;l<a;++l){let u=r.start+o*l/(a-1),d=this.motionQuantities(r.snapshot(u),r,e);i.times.push(u),i.values.push(d.find(h=>h.name===e)?.value??null)}return i}historyOf(e,n){let r=this.histories.get(e);return r||this.histories.set(e,r={name:os(e),unit:n,times:[],values:[]}),r}motionQuantities(e,n,r=""){let s=this.head.vehicles[this.vehicle];if(!s)return[];let i=Ml(this.head,e,s.body),[o,a,l]=Re(i),u=this.zAxisSign(s.body),d=Math.atan2(i[0],i[4])*Gi,h=[{name:"depth",unit:"m",value:this.head.water.surface_height-l},{name:"heading",unit:"deg",value:Math.round(10*(d+360))/10%360},{name:"roll",unit:"deg",value:Math.atan2(u*i[9],u*i[10])*Gi},{name:"pitch",unit:"deg",value:Math.asin(Math.max(-1,Math.min(1,i[8])))*Gi},{name:"speed",unit:"m/s",value:n.speed(s.body,e.time)}];(!r||r==="altitude")&&h.splice(1,0,{name:"altitude",unit:"m",value:this.altitude([o,a,l],s.name,e)});let p=["x","y","z"].map(_=>e.signal(`water/${s.name}/${_}`)??0),b=Math.hypot(...p);return(b>=.005||r)&&h.push({name:"current",unit:"m/s",value:b}),h}zAxisSign(e){let n=this.head.bodies.find(({name:r})=>r===e);return n&&st(n.pose)[10]<0?-1:1}altitude(e,n,r){let s=Me(e,[0,0,-xl]),i=a=>Ml(this.head,r,a),o=this.rays.cast(e,s,i,a=>a.vehicle===n);return o<1?o*xl:null}};function Ml(t,e,n){let r=t.bodies.find(({name:s})=>s===n);return e.poses.get(n)??st(r?.pose??[0,0,0,1,0,0,0])}function os(t){let[e,n]=[t.split("/")[0],t.slice(t.indexOf("/")+1)];return n===t||e==="joint"||n.toLowerCase().includes(e)?n:`${n} ${e}`}var Sl=100,Qh=["depth","speed"],Jh={deg:"°",1:"×"},as=class{constructor(e,n,r,s){this.quantities=e;this.player=n;this.redraw=s;this.curves=new tr(N("state"),r)}quantities;player;redraw;cells=new Map;selection=new Set;curves;hasSelection=!1;displayTime=0;isUpdatePending=!1;lastState=null;values=[];show(e,n,r){this.lastState=[e,n,r];let s=performance.now();s-this.displayTime>=Sl||!this.player.isLive?(this.displayTime=s,this.values=this.quantities.compute(e,this.player,n),this.player.isLive&&this.quantities.store(e.time,this.values),this.values.forEach(a=>this.fill(a))):this.isUpdatePending||(this.isUpdatePending=!0,setTimeout(()=>{this.isUpdatePending=!1,this.show(...this.lastState)},Sl)),N("hud").hidden=!r||!this.values.length,!this.hasSelection&&this.values.length&&this.selectInitial();let o=this.selectedCurves();N("state-box").hidden=!o.length,o.length&&this.curves.show(e.time,o)}redrawCurves(){this.curves.redraw()}selectInitial(){this.hasSelection=!0,this.player.isLive&&!this.player.curves.length&&!this.player.levels.length&&Qh.forEach(e=>this.selection.add(e)),this.mark()}selectedCurves(){return this.values.filter(({name:n})=>this.selection.has(n)).map(n=>this.quantities.history(n,this.player))}fill({name:e,unit:n,value:r}){let s=this.cells.get(e)??this.cell(e);s.value.textContent=Zh(r,n)}cell(e){let n=j("button","",e.startsWith("joint/")?"joint":""),r=j("output");n.append(j("span",os(e)),r),n.title=`${os(e)}: show or hide its curve`,n.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.hasSelection=!0,this.mark(),this.redraw()});let s={button:n,value:r};return this.cells.set(e,s),this.mark(),N("hud").append(n),s}mark(){for(let[e,{button:n}]of this.cells)n.setAttribute("aria-pressed",String(this.selection.has(e)))}};function Zh(t,e){if(t===null)return"–";let n={deg:1,m:2,"m/s":2,N:1,"%":0}[e]??2,r=t.toFixed(n).replace(/^-(0(\.0*)?)$/,"$1"),s=Jh[e]??` ${e}`;return`${r.replace("-","−")}${s}`}var em={orbit:["Orbit","Orbit around the vehicle (o)"],chase:["Chase","From behind the vehicle (b)"],camera:["Camera","Image of a camera (v)"],map:["Map","From above, north up (m)"],file:["File","From the <camera> of the scene file (p)"]},tm={clear:["Clear water","Water without fog (x)"],state:["State","Depth, heading, joints and more; a click on a number draws its curve (z)"],pictures:["Cameras","Images of the cameras (c)"],frames:["Frames","Coordinate frames with their names (f)"],trails:["Trails","Trails of bodies (t)"],sonars:["Sonars","Beams and fans (s)"]};function Al(t,e,n){for(let s of e){let[i,o]=em[s],a=j("button",i);a.title=o,a.dataset.mode=s,a.setAttribute("role","radio"),a.addEventListener("click",()=>t.show(s)),N("modes").append(a)}let r=N("camera");n.forEach((s,i)=>r.append(new Option(s,String(i)))),r.addEventListener("change",()=>{t.views.camera=Number(r.value),t.refresh()})}function Tl(t){let{sensors:e,cameras:n,vehicles:r}=t.pack.head,s={sonars:e.length,pictures:n.length,state:r.length};for(let[i,[o,a]]of Object.entries(tm)){if(s[i]===0)continue;let l=j("button",o);l.dataset.switch=i,l.title=a,l.addEventListener("click",()=>t.toggle(i)),N("switches").append(l)}}function Rl({views:t,switches:e,pack:n}){for(let s of N("modes").querySelectorAll("button"))s.setAttribute("aria-checked",String(s.dataset.mode===t.mode));for(let s of N("switches").querySelectorAll("button"))s.setAttribute("aria-pressed",String(e[s.dataset.switch]));let r=N("camera");r.hidden=t.mode!=="camera"||n.head.cameras.length<2,r.value=String(t.camera)}var Ll=["orbit","chase","camera","map","file"],rm=.9,nm=.4,ls=class{constructor(e,n,r){this.head=e;this.models=n;this.rays=r;this.orbit=Wi(e.view),this.restoreInitial()}head;models;rays;mode="orbit";camera=0;version=0;vehicle=0;holdOffset=null;orbit;file=null;chaseAzimuth=0;height=12;mapOffset=[0,0];follow(e){e!==this.vehicle&&(this.vehicle=e,this.version+=1)}toggleFollowing(){this.holdOffset=this.holdOffset?null:this.displacement(),this.version+=1}restoreInitial(){this.version+=1,this.holdOffset=null,this.orbit=Wi(this.head.view),this.file=this.head.file_view&&Wi(this.head.file_view),this.chaseAzimuth=0,this.mapOffset.fill(0),this.height=Math.max(6,2*this.orbit.distance)}viewCamera(e,n){let{view:r,file_view:s}=this.head,i=No(e,n,(this.mode==="file"&&s?s:r).fovy),o=this.mode==="camera"?this.head.cameras[this.camera]:void 0;if(o){let l=ji(o,e,n);return{worldFromCamera:this.models.worldFromMount(o),intrinsics:l,isExternal:!1,camera:o}}let a;if(this.mode==="map"){let[l,u]=Me(this.centre(),[...this.mapOffset,0]);a=ti([l,u,this.centre()[2]+this.height],[l,u,this.centre()[2]],[0,1,0])}else if(this.mode==="chase"&&this.base()){let l=this.base(),u=Math.atan2(l[4],l[0])+Math.PI+this.chaseAzimuth;a=this.chasePose(u,Math.max(.15,this.orbit.elevation))}else if(this.mode==="file"&&this.file)a=gn(this.file);else{let l=Me(this.orbit.target,this.holdOffset??this.displacement());a=gn({...this.orbit,target:l})}return{worldFromCamera:a,intrinsics:i,isExternal:!0,camera:null}}drag(e,n,r){if(this.version+=1,this.mode==="map"||r)return this.move(e,n);this.mode==="chase"?this.chaseAzimuth-=4*e:this.activeView().azimuth-=4*e;let s=this.activeView();s.elevation=zi(s.elevation+3*n,-1.55,1.55)}zoom(e){this.version+=1,this.mode==="map"?this.height=zi(this.height*e,.5,2e3):this.activeView().distance=zi(this.activeView().distance*e,.1,2e3)}move(e,n){if(this.mode==="map"){let i=2*this.height*Math.tan(this.head.view.fovy/2);this.mapOffset[0]-=e*i,this.mapOffset[1]+=n*i;return}let r=this.activeView(),s=gn(r);r.target=Me(r.target,[s[0],s[4],s[8]],-e*r.distance),r.target=Me(r.target,[s[1],s[5],s[9]],n*r.distance)}activeView(){return this.mode==="file"&&this.file?this.file:this.orbit}chasePose(e,n){let r=this.centre(),{distance:s}=this.orbit,i=gn({target:r,azimuth:e,elevation:n,distance:s}),o=this.head.vehicles[this.vehicle].name,a=p=>this.models.body(p),l=.05*s,u=[[0,0],[l,0],[-l,0],[0,l],[0,-l]].map(([p,b])=>this.rays.cast(r,Pe(i,[p,b,0]),a,_=>_.vehicle===o)),d=Math.min(...u);if(d>=1)return i;let h=Math.max(Math.min(nm,s),rm*d*s);return gn({target:r,azimuth:e,elevation:n,distance:h})}base(){let e=this.head.vehicles[this.vehicle];return e?this.models.body(e.body):null}displacement(){let e=this.head.vehicles[this.vehicle],n=this.head.bodies.find(({name:r})=>r===e?.body);return n?Me(this.centre(),n.pose.slice(0,3),-1):[0,0,0]}centre(){let e=this.base();return e?Pe(e,[0,0,0]):this.head.view.at}};function Wi(t){let e=Me(Re(st(t.pose)),t.at,-1),n=Math.hypot(...e);return{target:[...t.at],azimuth:Math.atan2(e[1],e[0]),elevation:Math.asin(e[2]/n),distance:n}}function gn({target:t,azimuth:e,elevation:n,distance:r}){let[s,i]=[Math.cos(n),Math.sin(n)],o=_t([s*Math.cos(e),s*Math.sin(e),i]);return ti(Me(t,o,r),t)}function ji(t,e,n){let r=Math.min(n/t.height,e/t.width);return{width:e,height:n,fx:t.fx*r,fy:t.fy*r,cx:(e-1)/2+(t.cx-(t.width-1)/2)*r,cy:(n-1)/2+(t.cy-(t.height-1)/2)*r,skew:t.skew*r,near:t.near,far:t.far}}function zi(t,e,n){return Math.min(n,Math.max(e,t))}var Pl=[.1,.25,.5,1,2,5,10,20],cs=class{constructor(e,n,r,s,i,o){this.pack=e;this.player=n;this.picture=r;this.views=s;this.connection=i;this.switches.clear=wl(e.head),this.quantities=new is(e.head,o),this.hud=new as(this.quantities,n,a=>this.seek(a),()=>this.draw()),this.levels=new On(n,a=>{this.go(a)}),this.thrusters=new Nn(e.head),this.keyboard=new ns(this),this.build(),requestAnimationFrame(a=>this.tick(a))}pack;player;picture;views;connection;time=0;isPlaying=!1;speed=1;switches={clear:!0,pictures:!0,state:!0,frames:!1,labels:!1,trails:!0,sonars:!0,sun:""};curves=new tr(N("curves"),e=>this.seek(e));quantities;hud;levels;thrusters;keyboard;lastTick=performance.now();drawnKey="";note="";async go(e){let n=this.player.levels[e];!n||this.connection||(await this.select(n.trial),this.seek(n.level.start))}async select(e){if(e===this.player.trial)return;await this.player.select(e),N("message").textContent=Go(this.player)?"This trial has no recorded motion.":this.note,this.curves.set(this.player.curves);let{start:n,end:r}=this.player;this.levels.mark(n,r),Object.assign(N("time"),{min:String(n),max:String(r)})}seek(e){this.connection||(this.time=Math.min(this.player.end,Math.max(this.player.start,e)),this.draw())}play(e=!this.isPlaying){this.isPlaying=e,e&&!this.connection&&this.time>=this.player.end-1e-6&&(this.time=this.player.start),this.connection?.control(e?"play":"pause"),N("play").textContent=e?"Pause":"Play"}step(e){this.play(!1),this.connection?this.connection.control("step"):this.seek(this.time+e/30)}reset(){this.connection?this.connection.control("reset"):this.seek(this.player.levels[hr(this.player,this.time)]?.level.start??this.player.start)}setSpeed(e,n=!0){this.speed=e;let r=N("speed");[...r.options].some(({value:s})=>s===String(e))||r.append(kl(e)),r.value=String(e),n&&this.connection?.control("speed",e)}setState(e,n){this.isPlaying=!e,N("play").textContent=e?"Play":"Pause",this.setSpeed(n,!1)}changeSpeed(e){let n=i=>i||1/0,r=this.speeds().filter(i=>(n(i)-n(this.speed))*e>0),s=e>0?r[0]:r.at(-1);s!==void 0&&this.setSpeed(s)}speeds(){return this.connection?[...Pl,0]:Pl}show(e){this.modes().includes(e)&&(e==="camera"&&this.views.mode==="camera"&&(this.views.camera=(this.views.camera+1)%this.pack.head.cameras.length),this.views.mode=e,this.refresh())}modes(){let{cameras:e,file_view:n}=this.pack.head;return Ll.filter(r=>(r!=="camera"||e.length)&&(r!=="file"||n))}toggle(e){this.switches[e]=!this.switches[e],e==="frames"&&(this.switches.labels=this.switches.frames),this.connection?.subscribe(this.switches.pictures),this.refresh()}clearTrails(){this.player.clearTrails(this.time),this.draw()}toggleTheme(){let e=document.documentElement;e.dataset.theme=e.dataset.theme==="dark"?"light":"dark",this.curves.redraw(),this.hud.redrawCurves(),this.connection?.topics.redrawCurves()}draw(){this.player.isLive&&(this.time=this.player.end);let e=this.player.snapshot(this.time);this.hud.show(e,this.views.vehicle,this.switches.state);let n=this.picture.draw(this.player,e,this.views,this.switches);n&&this.connection?.requestView(n),this.levels.show(this.time),this.curves.show(this.time,this.player.curves),N("curves-box").hidden=!this.player.curves.length,this.connection?.topics.show(this.time),this.thrusters.show(e);let r=[...document.querySelectorAll("aside > section")];document.body.classList.toggle("bare",r.every(({hidden:s})=>s)),N("time").value=String(this.time),N("clock").textContent=this.player.isLive?`${this.time.toFixed(2)} s`:`${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`}tick(e){requestAnimationFrame(a=>this.tick(a));let n=Math.min(.25,(e-this.lastTick)/1e3);this.lastTick=e,this.isPlaying&&!this.connection&&(this.time=Math.min(this.player.end,this.time+n*this.speed),this.time>=this.player.end&&this.play(!1));let{clientWidth:r,clientHeight:s}=this.picture.canvas,o=[this.time,this.player.end,r,s,this.views.version,this.player.version].join()+JSON.stringify(this.switches);o!==this.drawnKey&&!document.hidden&&this.picture.isReady()&&(this.drawnKey=o,this.draw())}refresh(){Rl(this),this.draw()}build(){Al(this,this.modes(),this.pack.head.cameras.map(({name:r})=>r)),Tl(this);let e=N("speed");e.append(...this.speeds().map(kl)),e.addEventListener("change",()=>this.setSpeed(Number(e.value))),this.setSpeed(1,!1);let n=N("time");n.addEventListener("input",()=>this.seek(Number(n.value))),N("play").addEventListener("click",()=>this.play()),N("step").addEventListener("click",()=>this.step(1)),N("back").addEventListener("click",()=>this.step(-1)),N("back").hidden=N("line").hidden=this.player.isLive,N("help-button").addEventListener("click",Dn),this.refresh()}};function kl(t){return new Option(t?`${t}×`:"fastest",String(t))}var us=class{constructor(e,n){this.heap=e;this.positions=n;this.initialHeights=Float32Array.from({length:n.length/3},(r,s)=>n[3*s+2]-e.corner[2]),this.heights=this.initialHeights.slice()}heap;positions;heights;initialHeights;removals=[];lastHeights=null;set(e){return e===this.lastHeights?!1:(this.lastHeights=e,this.heights.set(e.subarray(0,this.heights.length)),!0)}apply(e){let n=this.removals,r=e.length>=n.length&&n.every((s,i)=>s===e[i]);if(r&&e.length===n.length)return!1;r||this.heights.set(this.initialHeights);for(let{position:s}of r?e.slice(n.length):e)s?this.remove(s):this.heights.set(this.initialHeights);return this.removals=e,!0}surface(){let{heap:e,heights:n}=this,[r,s]=e.columns,i=Float32Array.from(this.positions),o=new Int16Array(i.length),a=(l,u,d)=>{let[h,p]=[Math.max(0,l-1),Math.min(u-1,l+1)];return(d(p)-d(h))/((p-h)*e.cell)};for(let l=0;l<r;++l)for(let u=0;u<s;++u){let d=l*s+u,h=a(l,r,_=>n[_*s+u]),p=a(u,s,_=>n[l*s+_]),b=32767/Math.hypot(h,p,1);i[3*d+2]=e.corner[2]+n[d],o.set([-h*b,-p*b,b],3*d)}return{positions:i,normals:o}}remove([e,n,r]){let{heap:s,heights:i}=this,[o,a]=s.columns,l=s.reach**2,u=(_,w)=>[Math.max(0,Math.floor((_-s.reach)/s.cell)),Math.min(w-1,Math.ceil((_+s.reach)/s.cell))],[[d,h],[p,b]]=[u(e,o),u(n,a)];for(let _=d;_<=h;++_)for(let w=p;w<=b;++w){let S=_*a+w;(_*s.cell-e)**2+(w*s.cell-n)**2+(i[S]-r)**2<l&&(i[S]=Math.max(0,i[S]-s.bite))}}};var Il=`// Provides: pixels without a surface: the water's far colour, range inf, id 0.
// Needs: frame.glsl, grey.glsl, targets.glsl.
// The far colour is the limit of the water's image model at infinite distance.
#include "frame.glsl"
#include "grey.glsl"
#ifdef PHYSICAL
#include "optics.glsl"
#endif
#include "targets.glsl"

void main() {
#ifdef COLOUR
#ifdef PHYSICAL
    colour_out = vec4(0.0, 0.0, 0.0, FAR);
#else
    colour_out = vec4(camera_colour(background.rgb), 1.0);
#endif
#endif
#ifdef RANGE
    range_out = uintBitsToFloat(0x7f800000u);
#endif
#ifdef IDS
    id_out = 0u;
#endif
}
`;var Fl=`// Provides: one triangle over the whole image at the far plane.
// Needs: nothing; three vertices without attributes.
// Depth 1 passes only where nothing has been drawn.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
`;var Cl=`// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
// Needs: gaussian.glsl; the level after its rows; with WIDER, the sum of the wider levels at half the resolution; with LAMPS,
// the number of lamps: optics.glsl, lamps.glsl, lamp_veil.glsl, and the mean light, whose alpha is the range. With VEIL_ONLY there
// is no level.
#include "gaussian.glsl"
uniform sampler2D level_0;
#ifdef WIDER
uniform sampler2D level_1;
#endif
#ifdef LAMPS
#include "optics.glsl"
#include "lamps.glsl"
#include "lamp_veil.glsl"
uniform sampler2D level_2;
#endif
out vec4 light_out;

void main() {
#ifdef VEIL_ONLY
    vec3 sum = vec3(0.0);
#else
    vec3 sum = gaussian(level_0, ivec2(0, 1)).rgb;
#endif
#ifdef WIDER
    sum += textureLod(level_1, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_1, 0))), 0.0).rgb;
#endif
#ifdef LAMPS
    float range = texelFetch(level_2, ivec2(gl_FragCoord.xy), 0).a;
    vec2 pixel = 2.0 * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    for (int i = 0; i < LAMPS; ++i) sum += lamp_veil(i, ray, range);
#endif
    light_out = vec4(sum, 1.0);
}
`;var Ol=`// Provides: the Gaussian of a level of blur along its rows.
// Needs: gaussian.glsl; the texture of the level.
// blurred.frag.glsl adds that along the columns.
#include "gaussian.glsl"
uniform sampler2D level_0;
out vec4 light_out;

void main() {
    light_out = gaussian(level_0, ivec2(1, 0));
}
`;var Nl=`// Provides: caustic_excess(place, depth, depths, swell_frame), the gain of the sun's beam by the moving surface, minus 1.
// Needs: the maps of caustics/caustic_map.py; with SWELL the grid of caustics/swell.py; place: where the beam enters, in tiles.
// The light of one depth is interpolated between two maps. Above the first it is linear, and far below the last contrast falls.
uniform sampler2DArray caustic_maps;
#ifdef SWELL
uniform sampler2D swell_map;
#endif

#ifdef MAP_LEVEL
#define READ_MAP(place, index) textureLod(caustic_maps, vec3(place, index), map_level)
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame, float map_level) {
#else
#define READ_MAP(place, index) texture(caustic_maps, vec3(place, index))
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame) {
#endif
    float z = max(depth, 0.0);
    float density = 1.0;
#ifdef SWELL
    vec4 swell = textureLod(swell_map, place * frame.z + frame.xy, 0.0);
    vec2 inside = step(abs(place * frame.z + frame.xy - 0.5), vec2(0.5));
    density = 1.0 - z * (swell.z - z * swell.w) * inside.x * inside.y;
    place -= z * frame.w * swell.xy;
#endif
    float level = clamp(log2(max(z, depths.x)) * depths.y + depths.z, 0.0, float(N_SLICES - 1));
    float layer = step(0.5 * float(N_SLICES), level);  // of the maps 0 to 3, or 2 to 5
    vec4 shares = max(1.0 - abs(vec4(0.0, 1.0, 2.0, 3.0) + 2.0 * layer - level), 0.0);
    float excess = dot(READ_MAP(place, layer), shares);
    float far = depths.w / max(z, depths.w);
    return (1.0 + excess * min(z / depths.x, 1.0) * far * far) * density - 1.0;
}
`;var Dl=`// Provides: the block Caustics, the numbers of caustics that are constant in an image.
// Needs: nothing. Filled by caustics/caustic_light.py, where the same members are declared.
// A tile is the unit of length of maps.
layout(std140) uniform Caustics {
    vec4 caustic_x;       // place where the beam to a point in the camera frame enters: x of W = xyz * point + w [tiles]
    vec4 caustic_y;       // the same for y of W
    vec4 swell_frame;     // xy, z: coordinates in the grid of long waves = z * place + xy; w: tiles in a metre
    vec4 caustic_depths;  // x: first depth [m]; y, z: index of a map = y log2(depth) + z; w: last depth [m]
    vec4 caustic_loss;    // rgb: rate at which the contrast falls with depth [1/m]; w: greatest b p / (b* p*) in shafts on the way to the surface
    vec4 shaft_numbers;   // x: asymmetry of p*; y: b* / b; z: longest way [m]; w: texels in a tile
};
`;var Ul=`// Provides: daylight(facing, up_cosine, share, depth), the light of sun and sky under water; albedo_of(stored), a surface's albedo.
// Needs: varyings.glsl with PHYSICAL; facing = N.L; up_cosine = N.up; share = 0 in the sun's shadow to 1; depth below the surface [m].
// physical/daylight_field.py, physical/transfer_curve.py: the sun's beam, with CAUSTICS focused by waves; diffuse light from above, light from below.
#ifdef CAUSTICS
#include "caustics.glsl"
#endif
vec3 daylight(float facing, float up_cosine, float share, float depth) {
    float z = max(depth, 0.0);
    vec3 total = v_daylight_total * exp(v_daylight_loss * -z);
    vec3 level = min(v_sun_beam.rgb * exp(v_sun_loss * -z), total);
    vec3 diffuse = total - level;
#ifdef CAUSTICS
    level *= 1.0 + exp(v_caustic_loss * -z) * caustic_excess(v_caustic_place, depth, v_caustic_depths, v_swell_frame);
#endif
    return level * (max(facing, 0.0) * share / v_sun_beam.w)
        + diffuse * (0.5 + 0.5 * up_cosine) + v_upwelling * total * (0.5 - 0.5 * up_cosine);
}

vec3 albedo_of(vec3 stored) {
    vec3 root = sqrt(stored);
    return stored * (0.0982065878 + root * (-0.2653148210 + root * (0.7011382242 + root * (0.5186992531 - 0.0527292441 * root))));
}
`;var Hl=`// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
// Needs: optics.glsl, transmission.glsl, open_water.glsl, grey.glsl; the image of the surfaces; with SCATTERED, the sum of the
// levels; with PARTICLES, the image of the particles; with SHAFTS, the edge of a texel [px], that of the shafts; the switches BLUR,
// LINEAR for no curve, and LIGHT for no exposure either.
// B + D (J - B) + blur + veil: physical/development.py; the curve: physical/transfer_curve.py.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
#include "grey.glsl"
uniform sampler2D surface_image;
#ifdef SCATTERED
uniform sampler2D level_0;
#endif
#ifdef PARTICLES
uniform sampler2D particle_image;
#endif
#ifdef SHAFTS
uniform sampler2D shaft_image;
#endif
#ifdef CLOUDS
#include "clouds.glsl"
#include "cloud_edge.glsl"
uniform sampler2D cloud_layers_map;
uniform sampler2D cloud_lamplight_map;
uniform sampler2D cloud_daylight_map;

vec3 through_clouds(vec3 light, vec3 water, float range) {
    vec2 place = gl_FragCoord.xy / (float(CLOUD_EDGE) * vec2(textureSize(cloud_layers_map, 0)));
    vec4 layers = textureLod(cloud_layers_map, place, 0.0);
    vec4 lamplight = textureLod(cloud_lamplight_map, place, 0.0);
    vec3 daylight = textureLod(cloud_daylight_map, place, 0.0).rgb;
    vec4 shares = clamp((range - cloud_layers.x) / cloud_layers.y - vec4(0.0, 0.0, 1.0, 2.0), 0.0, 1.0);
    float depth = layers.x + dot(shares.yzw, layers.yzw - layers.xyz);
    vec3 mean = 1.0 / max(vec3(lamplight.a), 1e-6);
    vec3 veil = mean * lamplight.rgb * ((1.0 - exp(-LOSS_SHARE * depth)) / LOSS_SHARE);
    return mix(water + mean * daylight, light, exp(-depth)) + veil;
}
#endif
out vec4 colour_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(surface_image, 0);
    vec4 texel = texelFetch(surface_image, pixel, 0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(size));
    vec3 light = water;
#ifdef SHAFTS
    light += textureLod(shaft_image, gl_FragCoord.xy / (float(SHAFTS) * vec2(textureSize(shaft_image, 0))), 0.0).rgb;
#endif
    float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
    float range = texel.a * is_surface;
    vec3 excess = (texel.rgb - water) * is_surface;
#ifdef BLUR
    vec3 sharp = direct(range) + weight(0, range);
#else
    vec3 sharp = whole_field(range);
#endif
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    excess *= 1.0 - min(particles.a, 1.0);
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    light += textureLod(level_0, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_0, 0))), 0.0).rgb;
#endif
#ifdef CLOUDS
    light = through_clouds(light, water, is_surface > 0.5 ? range : FAR);
#endif
#ifdef LIGHT
    colour_out = vec4(light, 1.0);
#else
    vec3 value = clamp(light * camera.y, 0.0, 1.0);
#ifndef LINEAR
    vec3 second = sqrt(value);
    vec3 fourth = sqrt(second);
    vec3 curve = 0.642363 * second + 0.71211342 * fourth - 0.33687116 * sqrt(fourth) - 0.01756212 * value;
    value = mix(12.92 * value, curve, step(0.0031308, value));
#endif
    colour_out = vec4(camera_colour(value), 1.0);
#endif
}
`;var Vl=`// Provides: the block Frame: values that are constant in an image.
// Needs: nothing. Filled by frame.py, where the same members are declared.
// Camera frame: OpenGL axes (x right, y up, -z ahead), metres.
layout(std140) uniform Frame {
    mat4 clip_from_camera;
    mat4 shadow_from_camera;  // to texture coordinates and depth, 0..1
    vec4 up;                  // xyz: W's z axis, camera frame; w: camera's height above the water [m]
    vec4 sun;                 // xyz: towards the sun, camera frame; w: offset along normals against self-shadowing [m]
    vec4 sunlight;            // rgb: colour of the sun times the light rate
    vec4 ambient_specular;    // x: ambient, y: specular brightness, both times the light rate
    vec4 water_colour;        // rgb: colour of in-scattered light
    vec4 attenuation;         // rgb [1/m]
    vec4 fog;                 // rgb: colour; w: density squared [1/m2]
    vec4 clip_fog;            // clip-space z, the distance in UWSim's fog = x * planar depth + y [m]
    vec4 background;          // rgb: colour of pixels without a surface
};
`;var Bl=`// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1).
// Needs: the switches RADIUS [texels] and SPREAD, a thousand times the standard deviation [texels].
// Outside the level its edge is continued.
vec4 gaussian(sampler2D level, ivec2 step_) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(level, texel, 0);
#if RADIUS > 0
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    float total = 1.0;
    for (int i = 1; i <= RADIUS; ++i) {
        float weight = exp(-rate * float(i * i));
        sum += weight * (texelFetch(level, clamp(texel - i * step_, ivec2(0), last), 0)
            + texelFetch(level, clamp(texel + i * step_, ivec2(0), last), 0));
        total += 2.0 * weight;
    }
    sum /= total;
#endif
    return sum;
}
`;var Gl=`// Provides: camera_colour(colour), the colour of a pixel in the image of a colour or grey camera.
// Needs: nothing.
// With the switch GREY: int(0.2989 R) + int(0.5870 G) + int(0.1140 B) of 8-bit values, as in grey.py. Only the viewer's page sets it.
vec3 camera_colour(vec3 colour) {
#ifdef GREY
    vec3 stored = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    vec3 terms = floor(stored * vec3(0.2989, 0.5870, 0.1140) + 5e-5);
    return vec3((terms.r + terms.g + terms.b) / 255.0);
#else
    return colour;
#endif
}
`;var Wl=`// Provides: the block Instance: the pose of one instance in the camera frame, and its id.
// Needs: nothing. Filled by instance.py, where the same members are declared.
// camera_normals is the inverse transpose of camera_from_model (scale may be uneven).
layout(std140) uniform Instance {
    mat4 camera_from_model;
    mat4 camera_normals;
    uvec4 identity;  // x: id, 1..65535
};
`;var zl=`// Provides: the radiance of a lamp that the camera sees, and its range.
// Needs: optics.glsl, targets.glsl with COLOUR; the outputs of lamp_point.vert.glsl. The renderer adds radiance and replaces range.
// pi I lobe / (d^2 Omega) with the solid angle Omega of a pixel, divided among the four pixels around the lamp.
#include "optics.glsl"
#include "targets.glsl"
flat in vec3 v_position;
flat in vec3 v_axis;
flat in vec4 v_light;
flat in float v_steepness;

void main() {
    float range = max(length(v_position), 0.01);
    float cosine = dot(v_axis, v_position) / range;
    float share = v_light.w > -1.0 ? clamp((cosine - v_light.w) * v_steepness, 0.0, 1.0) : 1.0;
    vec2 slope = v_position.xy / -v_position.z - ray_first.xy;
    float row = slope.y / ray_row.y;
    float column = (slope.x - row * ray_row.x) / ray_column.x;
    vec2 weight = max(1.0 - abs(gl_FragCoord.xy - vec2(column, row)), 0.0);
    float part = weight.x * weight.y * share * share * (3.0 - 2.0 * share);
    if (part <= 0.0) discard;
    float axis_cosine = -v_position.z / range;
    float solid_angle = axis_cosine * axis_cosine * axis_cosine * abs(ray_column.x * ray_row.y);
    colour_out = vec4(v_light.rgb * (3.14159265 * part / (range * range * solid_angle)), range);
}
`;var jl=`// Provides: a point of 3 x 3 pixels where the camera sees a lamp.
// Needs: frame.glsl, lamps.glsl with LAMPS; a vertex for each lamp, without attributes.
// The depth is that of a point 0.1 m nearer, so that a lamp's own housing does not hide it.
#include "frame.glsl"
#include "lamps.glsl"
flat out vec3 v_position;  // of the lamp, camera frame [m]
flat out vec3 v_axis;
flat out vec4 v_light;     // rgb: intensity times colour; w: cosine at the edge of the cone
flat out float v_steepness;

void main() {
    int i = gl_VertexID;
    v_position = lamp_position[i].xyz;
    v_axis = lamp_axis[i].xyz;
    v_light = vec4(lamp_light[i].rgb, lamp_position[i].w);
    v_steepness = lamp_axis[i].w;
    gl_Position = clip_from_camera * vec4(v_position, 1.0);
    float range = max(length(v_position), 1e-3);
    vec4 nearer = clip_from_camera * vec4(v_position * max(1.0 - 0.1 / range, 0.5), 1.0);
    if (gl_Position.w > 0.0 && nearer.w > 0.0) gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    gl_PointSize = 3.0;
}
`;var Yl=`// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
// Needs: optics.glsl, lamps.glsl with LAMPS. optics/lamp_light.py has the formulas; no shadows.
// With u = tan(pi/4 + eta/2): cos(eta) = 2u / (1 + u^2), sin(eta) = (u^2 - 1) / (1 + u^2), t + d = t0 + h u.
vec3 veil_sample(float u, float weight, float foot, float height, float foot_axis, float ray_axis, int i, vec3 loss) {
    u = u >= 0.0 ? min(u, 1e5) : 1e5;  // rounding at far points of the ray
    float square = u * u;
    float inverse = 1.0 / (1.0 + square);
    float cosine = 2.0 * u * inverse;
    float sine = 1.0 - 2.0 * inverse;
    float share = clamp((foot_axis * cosine + ray_axis * sine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
    float q = sqrt(sqrt(square * inverse));
    vec4 even = phase_high;
    float log_phase = even.w;
    log_phase = log_phase * q + even.z;
    log_phase = log_phase * q + even.y;
    log_phase = log_phase * q + even.x;
    log_phase = log_phase * q + phase_low.w;
    log_phase = log_phase * q + phase_low.z;
    log_phase = log_phase * q + phase_low.y;
    log_phase = log_phase * q + phase_low.x;
    return exp(log_phase - loss * (foot + height * u)) * (weight * share * share * (3.0 - 2.0 * share));
}

vec3 lamp_veil(int i, vec3 ray, float range) {
    vec3 to_lamp = lamp_position[i].xyz;
    vec3 axis = -lamp_axis[i].xyz;
    float foot = dot(ray, to_lamp);
    vec3 foot_vector = foot * ray - to_lamp;
    float height = max(length(foot_vector), 1e-3);
    float begin = 0.0;
    float end = range;
    float ray_axis = dot(ray, axis);
    if (lamp_optics[i].w > 0.5) {
        // A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
        float origin = -dot(to_lamp, axis);
        float a = ray_axis * ray_axis - lamp_optics[i].z;
        a = abs(a) < 1e-7 ? 1e-7 : a;
        float b = ray_axis * origin + lamp_optics[i].z * foot;
        float c = origin * origin - lamp_optics[i].z * dot(to_lamp, to_lamp);
        float discriminant = b * b - a * c;
        float root = sqrt(max(discriminant, 0.0));
        float first = (-b - root) / a;
        float second = (-b + root) / a;
        float near = min(first, second);
        float far = max(first, second);
        bool is_lit = true;
        if (a > 0.0) {
            begin = ray_axis > 0.0 ? max(far, 0.0) : 0.0;
            end = ray_axis > 0.0 ? end : min(end, near);
        } else {
            is_lit = discriminant > 0.0 && origin + 0.5 * (near + far) * ray_axis > 0.0;
            begin = max(near, 0.0);
            end = min(end, far);
        }
        if (!is_lit || end <= begin) return vec3(0.0);
    }
    // Light that a lamp sends to the camera and the water scatters forward is in the blur of the lamp's own image.
    float cosine = dot(lamp_axis[i].xyz, to_lamp) / max(length(to_lamp), 1e-3);
    float direct_share = lamp_position[i].w > -1.0 ? clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
    begin = max(begin, mix(begin, foot, direct_share));
    if (end <= begin) return vec3(0.0);
    float low = atan((begin - foot) / height);
    float high = atan((end - foot) / height);
    float half_width = 0.25 * (high - low);
    float middle = tan(0.78539816 + 0.25 * (high + low));
    float inner = tan(0.3399810435848563 * half_width);
    float outer = tan(0.8611363115940526 * half_width);
    float foot_axis = dot(foot_vector, axis) / height;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b
    vec3 sum = veil_sample(max(middle - outer, 0.0) / (1.0 + middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample(max(middle - inner, 0.0) / (1.0 + middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + inner) / (1.0 - middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + outer) / (1.0 - middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss);
    return scattering.rgb * lamp_light[i].rgb * sum * (6.283185307 * half_width / height);  // pi b I (high - low) / 2 / h
}
`;var ql=`// Provides: lamplight(colour, unit_normal), the light of the lamps that a surface reflects.
// Needs: varyings.glsl and lamps.glsl with LAMPS; their shadow maps, four tiles of one texture.
// With MICROFACET, material.glsl replaces the colour.
// colour k I max(N.D, 0) / d^2 cone exp(-a d) * share of the light that no body blocks: see lamp.py.
uniform sampler2DShadow lamp_maps;

vec3 lamplight(vec3 colour, vec3 unit_normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float distance = max(length(towards), 0.01);
        float facing = dot(unit_normal, towards) / distance;
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone_position = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        if (facing > 0.0 && cone_position > 0.0) {
            float cone = cone_position * cone_position * (3.0 - 2.0 * cone_position);
            float share = 1.0;  // a lamp that shines in all directions casts no shadows
            if (lamp_position[i].w > -1.0)
                share = textureLod(lamp_maps, v_lamp_uv[i].xyz / v_lamp_uv[i].w, 0.0);
#ifdef PHYSICAL
            // c - b e of a wide target, as optics/lamp_light.py has it for the way there
            vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
            vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
#else
            vec3 transmission = exp(v_attenuation * -distance);
#endif
            vec3 arriving = lamp_light[i].rgb * transmission * (facing * cone * share / (distance * distance));
#ifdef MICROFACET
            arriving *= reflected_share(unit_normal, towards / distance, facing);
#endif
            sum += arriving;
        }
    }
#ifdef MICROFACET
    return sum;
#else
    return colour * sum;
#endif
}
`;var Xl=`// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, the number of lamps, 1..4. Filled by lamps.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to homogeneous texture coordinates and depth in the shadow maps
    vec4[4] lamp_position;     // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: opposite to the beam; w: factor from cosines inside the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var $l=`// Provides: with NORMAL_MAP, mapped_normal(unit_normal); with MICROFACET, prepare_material, material_daylight, reflected_share.
// Needs: varyings.glsl; with MICROFACET: daylight.glsl, the table of reflectance.py, and with FINISH_MAP a map of occlusion, roughness, metal.
// pi times the BRDF of a rough surface: Lambert under a layer of GGX's microfacets: reflectance.py.
#ifdef NORMAL_MAP
uniform sampler2D normal_map;

vec3 mapped_normal(vec3 unit_normal) {
    vec3 local = texture(normal_map, v_uv).xyz * (255.0 / 127.5) - 1.0;
    vec3 outward = gl_FrontFacing ? unit_normal : -unit_normal;
    vec3 across = cross(outward, v_tangent.xyz) * v_tangent.w;
    vec3 mapped = v_finish.z * (local.x * v_tangent.xyz + local.y * across) + local.z * outward;
    mapped *= inversesqrt(max(dot(mapped, mapped), 1e-12));
    return gl_FrontFacing ? mapped : -mapped;
}
#endif
#ifdef MICROFACET
#define MIN_ROUGHNESS 0.08  // these are the constants of reflectance.py; the indices are squared and relative to the medium
#define WATER_INDEX 1.2530631
#define AIR_INDEX 2.25
uniform sampler2D reflectance_table;
#ifdef FINISH_MAP
uniform sampler2D finish_map;
#endif
vec3 surface_view;      // towards the camera
vec3 surface_diffuse;   // albedo below the layer, times the light that passes the layer
vec3 surface_metal;     // colour of metal
vec3 surface_gain;      // factor on its reflection for light that microfacets reflect several times
vec4 surface_finish;    // x: roughness; y: share of metal; z: squared width; w: n.v
vec2 surface_factors;   // x: squared relative index of a dielectric; y: share of the diffuse daylight that arrives
vec3 surface_mirror;    // reflectance of the layer under even light

// Fresnel's reflectance of a dielectric, or Schlick's of a metal, from the cosine of incidence.
vec3 fresnel(float cosine) {
    float g = sqrt(surface_factors.x - 1.0 + cosine * cosine);
    float minus = g - cosine;
    float plus = g + cosine;
    float ratio = minus / plus;
    float second = (cosine * plus - 1.0) / (cosine * minus + 1.0);
    float dielectric = 0.5 * ratio * ratio * (1.0 + second * second);
    float rest = 1.0 - cosine;
    float power = rest * rest;
    power *= power * rest;
    return mix(vec3(dielectric), surface_gain * (surface_metal + (1.0 - surface_metal) * power), surface_finish.y);
}

// Set the variables above for a pixel; call it before the functions below.
void prepare_material(vec3 albedo, vec3 normal, float depth) {
    float roughness = v_finish.x;
    float metallic = v_finish.y;
    float occlusion = 1.0;
#ifdef FINISH_MAP
    vec3 finish_texel = texture(finish_map, v_uv).rgb;
    occlusion = finish_texel.r;
    roughness *= finish_texel.g;
    metallic *= finish_texel.b;
#endif
    roughness = max(roughness, MIN_ROUGHNESS);
    float width = roughness * roughness;
    surface_view = -v_position * inversesqrt(dot(v_position, v_position));
    float nv = clamp(dot(normal, surface_view), 0.001, 1.0);
    vec2 texels = vec2(textureSize(reflectance_table, 0));
    vec3 table = textureLod(reflectance_table, (vec2(nv, roughness) * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
    bool is_wet = depth > 0.0;
    float dielectric = is_wet ? table.g : table.b;
    surface_finish = vec4(roughness, metallic, width * width, nv);
    surface_factors = vec2(is_wet ? WATER_INDEX : AIR_INDEX, occlusion);
    surface_metal = albedo;
    surface_diffuse = albedo * ((1.0 - metallic) * (1.0 - dielectric));
    surface_gain = 1.0 + albedo * (1.0 / table.r - 1.0);
    surface_mirror = mix(vec3(dielectric), albedo * table.r * surface_gain, metallic);
}

// The share of a beam that the camera receives, pi times the BRDF; facing = normal . towards > 0.
vec3 reflected_share(vec3 normal, vec3 towards, float facing) {
    vec3 middle = towards + surface_view;
    middle *= inversesqrt(max(dot(middle, middle), 1e-12));
    float nh = dot(normal, middle);
    float square = surface_finish.z;
    float nv = surface_finish.w;
    float nl = max(facing, 1e-4);
    float peak = nh * nh * (square - 1.0) + 1.0;
    float shadowing = nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square);
    float facets = 0.5 * square / (peak * peak * shadowing);
    return surface_diffuse + facets * fresnel(clamp(dot(surface_view, middle), 0.0, 1.0));
}

// The light of sun and sky that the surface reflects; the arguments are those of daylight.
vec3 material_daylight(vec3 normal, float facing, float upward, float share, float depth) {
    vec3 even = daylight(0.0, upward, share, depth);
    vec3 beam = daylight(1.0, upward, share, depth) - even;
    float mirrored_up = 2.0 * dot(normal, surface_view) * upward - dot(surface_view, v_up);
    float lobe = clamp(mirrored_up / surface_finish.x, -1.0, 1.0);
    vec3 mirrored = daylight(0.0, lobe, share, depth);
    vec3 total = surface_factors.y * (even * surface_diffuse + mirrored * surface_mirror);
    if (facing > 0.0) total += beam * (facing * reflected_share(normal, v_sun, facing));
    return total;
}
#endif
`;var Kl=`// Provides: open_water(pixel, size), the radiance of open water behind a pixel; pixel counts as gl_FragCoord does.
// Needs: the small texture of physical/open_water_map.py.
// Its outer texels are at the image's corners.
uniform sampler2D open_water_map;

vec3 open_water(vec2 pixel, vec2 size) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return textureLod(open_water_map, (pixel / size * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
}
`;var Ql=`// Provides: the block Optics, the numbers of physical water; and FAR, the range of pixels without a surface.
// Needs: nothing. Filled by physical/optics_block.py, where the same members are declared.
// Rays are in the camera frame (OpenGL axes), with z = -1, linear in gl_FragCoord.
#ifndef FAR
#define FAR 1e9
#endif
layout(std140) uniform Optics {
    vec4 absorption;       // rgb: a [1/m]; w: e0 of the whole field
    vec4 scattering;       // rgb: b [1/m]; w: k of the whole field
    vec4[2] reach;         // factors on the ranges of the levels of blur: blur_plan.py
    vec4 camera;           // y: exposure; z: middle range of the table of weights [m]
    vec4 sun_beam;         // rgb: irradiance of a level surface just below the surface by the sun
    vec4 sun_loss;         // rgb: its attenuation over depth [1/m]
    vec4 daylight_total;   // rgb: irradiance of a level surface just below the surface
    vec4 daylight_loss;    // rgb: its attenuation over depth [1/m]
    vec4 upwelling;        // rgb: share of the irradiance that comes up; w: cosine of the sun from the zenith
    vec4 phase_low;        // ln p as a polynomial of ((1 - cos) / 2)^(1/4): the lower four coefficients
    vec4 phase_high;       // the higher four
    vec4 ray_first;        // the ray at gl_FragCoord = 0
    vec4 ray_column;       // its change from column to column
    vec4 ray_row;          // its change from row to row
    vec4[4] lamp_optics;   // x: EE(half angle) - A; y: k_L; z: squared cosine of the half angle; w: 1 if it is below 90 degrees
};
`;var Jl=`// Provides: projected(dry, colour, unit_normal), the light of a surface with the projected pattern.
// Needs: varyings.glsl and projector.glsl with PROJECTOR; the textures of the pattern and of the shadow map.
// A laser replaces the light by the pattern's colour, 0 or 1 in each channel, times exp(-a d). A lamp adds
// colour p max(N.D, 0) / d^2 exp(-a d) * share of the light that no body blocks: see projector.py.
uniform sampler2DShadow projector_map;
uniform sampler2D projector_pattern;

vec3 projected(vec3 dry, vec3 colour, vec3 unit_normal) {
    vec3 map_point = v_projector_uv.xyz / v_projector_uv.w;
    vec3 towards = projector_position.xyz - v_position;
    float distance = max(length(towards), 0.01);
    float facing = dot(unit_normal, towards) / distance;
    vec2 outside = step(0.5, abs(map_point.xy - 0.5));
    if (v_projector_uv.w <= 0.1 || facing <= 0.0 || outside.x + outside.y > 0.0) return dry;
    vec4 pattern = textureLod(projector_pattern, map_point.xy, 0.0);
    if (pattern.a < 0.5) return dry;
    float share = textureLod(projector_map, vec3(map_point.xy, min(map_point.z, 1.0)), 0.0);
    vec3 transmission = exp(v_attenuation * -distance);
    if (projector_position.w < 0.5)
        return dry + colour * pattern.rgb * transmission * (share * facing / (distance * distance));
    vec3 beam = step(0.5, pattern.rgb);
    float channels = beam.r + beam.g + beam.b;
    bool is_white = min(pattern.r, min(pattern.g, pattern.b)) >= 1.0;
    return share < 0.5 || channels < 0.5 || is_white ? dry : beam * transmission;
}
`;var Zl=`// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to homogeneous texture coordinates and depth in the shadow map
    vec4 projector_position;     // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: opposite to the beam; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var ec=`// Provides: the levels of blur after the second, each at half the resolution: texels weighed by 1, 3, 3, 1 along rows and columns.
// Needs: the textures of the levels; the switch N_LEVELS, how many there are, 1 to 6.
// Four linear look-ups are the sixteen weights; those outside the level have none.
uniform sampler2D level_0;
uniform sampler2D level_1;
uniform sampler2D level_2;
uniform sampler2D level_3;
uniform sampler2D level_4;
uniform sampler2D level_5;
layout(location = 0) out vec4[N_LEVELS] level_out;

vec4 smooth_mean(sampler2D level) {
    vec2 size = vec2(textureSize(level, 0));
    vec2 low = (2.0 * gl_FragCoord.xy - 0.75) / size;
    vec2 high = low + 1.5 / size;
    vec2 inside = step(high, vec2(1.0));
    vec4 sum = textureLod(level, low, 0.0) + inside.x * inside.y * textureLod(level, high, 0.0)
        + inside.y * textureLod(level, vec2(low.x, high.y), 0.0)
        + inside.x * textureLod(level, vec2(high.x, low.y), 0.0);
    return sum / ((1.0 + inside.x) * (1.0 + inside.y));
}

void main() {
    level_out[0] = smooth_mean(level_0);
#if N_LEVELS > 1
    level_out[1] = smooth_mean(level_1);
#endif
#if N_LEVELS > 2
    level_out[2] = smooth_mean(level_2);
#endif
#if N_LEVELS > 3
    level_out[3] = smooth_mean(level_3);
#endif
#if N_LEVELS > 4
    level_out[4] = smooth_mean(level_4);
#endif
#if N_LEVELS > 5
    level_out[5] = smooth_mean(level_5);
#endif
}
`;var tc=`// Provides: the light that levels of blur scatter, w_l (J - B), before their Gaussians.
// Needs: optics.glsl, transmission.glsl, open_water.glsl; the image of the surfaces; the switch N_LEVELS.
// The first run is at half the resolution and for one level; its last output is the mean of J - B, with the mean range as alpha, or FAR.
// The second run has the switch WIDE: it is twice as coarse, for all other levels, and reads that mean.
// J: radiance of a surface without water, B: of open water behind it. Pixels without a surface scatter nothing.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
#ifdef WIDE
#define FIRST 1
layout(location = 0) out vec4[N_LEVELS] level_out;
#else
#define FIRST 0
layout(location = 0) out vec4[N_LEVELS + 1] level_out;
#endif

vec4 scattered(int level, float range, vec3 excess) {
    return vec4(weight(1 + level, reach[level / 4][level % 4] * range) * excess, 0.0);
}

void main() {
    ivec2 size = textureSize(surface_image, 0);
    ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float ranges = 0.0;
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 texel = texelFetch(surface_image, min(corner + ivec2(i % 2, i / 2), size - 1), 0);
        float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
        sum += texel.rgb * is_surface;
        ranges += texel.a * is_surface;
        count += is_surface;
    }
    float range = ranges / max(count, 1.0);
#ifndef WIDE
    sum -= count * open_water(2.0 * gl_FragCoord.xy, vec2(size));
#endif
    vec3 excess = sum / 4.0;
    // no loop: WebGL's outputs have constant indices
#if N_LEVELS > 0
    level_out[0] = scattered(FIRST + 0, range, excess);
#endif
#if N_LEVELS > 1
    level_out[1] = scattered(FIRST + 1, range, excess);
#endif
#if N_LEVELS > 2
    level_out[2] = scattered(FIRST + 2, range, excess);
#endif
#if N_LEVELS > 3
    level_out[3] = scattered(FIRST + 3, range, excess);
#endif
#if N_LEVELS > 4
    level_out[4] = scattered(FIRST + 4, range, excess);
#endif
#if N_LEVELS > 5
    level_out[5] = scattered(FIRST + 5, range, excess);
#endif
#if N_LEVELS > 6
    level_out[6] = scattered(FIRST + 6, range, excess);
#endif
#ifndef WIDE
    level_out[N_LEVELS] = vec4(excess, count > 0.0 ? range : FAR);
#endif
}
`;var rc=`// Provides: one triangle over the whole target, without depth.
// Needs: nothing; three vertices without attributes.
// For the passes of physical water that work on whole images.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var nc=`// Provides: depth only, which the rasteriser writes.
// Needs: nothing.
// For all shadow maps.
void main() {}
`;var sc=`// Provides: sun_share(map_point), 0 in the sun's shadow to 1 in full sunlight.
// Needs: the shadow map; map_point = texture coordinates and depth of a point in it, 0..1.
// One hardware comparison of 2 x 2 texels, or with the switch SOFT the mean of four; points outside the map are lit.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 map_point) {
    vec3 inside = step(abs(map_point - 0.5), vec3(0.5));
#ifdef SOFT
    if (inside.x * inside.y * inside.z == 0.0) return 1.0;
    vec2 texel = 1.25 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int j = -1; j <= 1; j += 2) sum += textureLod(shadow_map, map_point + vec3(vec2(i, j) * texel, 0.0), 0.0);
    return sum / 4.0;
#else
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, map_point) : 1.0;
#endif
}
`;var ic=`// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector.
#include "instance.glsl"

in vec3 vertex;

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
}
`;var oc=`// Provides: sunlit(colour, facing, mirrored, lit), the sunlight and ambient light that a surface reflects.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sunlight that arrives, 0..1. N: normal,
// L: direction to the sun, R: direction of the mirrored sunlight, E: direction to the camera.
// With the switch POLISHED: surfaces are glossy, 0.3 max(R.E, 0)^32, and in the shade ambient light has the
// water's hue.
// Else UWSim's image model: q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 where N.L > 0), with light rate q, surface
// colour C, and the ambient, diffuse and specular light Ia, Id, Is.
vec3 sunlit(vec3 colour, float facing, float mirrored, float lit) {
    float reached = facing > 0.0 ? lit : 0.0;
    float glint = max(mirrored, 0.0);
#ifdef POLISHED
    vec3 hue = v_water_colour.rgb / max(max(v_water_colour.r, v_water_colour.g), max(v_water_colour.b, 1e-3));
    vec3 ambient = v_lights.w * mix(0.8 + 0.35 * hue, vec3(1.0), reached);
    float narrow = glint * glint * glint * glint;
    narrow *= narrow;
    narrow *= narrow;
    narrow *= narrow;
    vec3 film = v_lights.rgb * (0.3 * narrow * reached);
    return colour * (ambient + v_lights.rgb * (facing * reached)) + film;
#endif
    return colour * (v_lights.w + v_lights.rgb * (facing * reached)) + v_water_colour.w * glint * glint * reached;
}
`;var ac=`// Provides: colour, range and id of a surface seen through water, whichever are requested.
// Needs: varyings.glsl, instance.glsl, sun.glsl, water.glsl, grey.glsl, shadow.glsl, lamplight.glsl, projection.glsl, targets.glsl, material.glsl.
// The switch ALPHA_TEST is the alpha of holes, 1..255 of 255. EMISSION and EMISSION_MAP add emitted light, under PHYSICAL only.
// The switch OPACITY is 1..254 of 255; without it the surface is opaque. The renderer blends.
// Light, then attenuation, then fog, on stored values; noise and conversion to 8 bit follow in noise.py.
#define VARYING in
#include "varyings.glsl"
#include "targets.glsl"
#ifdef IDS
#include "instance.glsl"
#endif
#ifdef COLOUR
#ifdef PHYSICAL
#include "optics.glsl"
#include "daylight.glsl"
#ifdef SKY
#include "surface_block.glsl"
#include "skylight.glsl"
#endif
#else
#include "sun.glsl"
#include "water.glsl"
#endif
#include "grey.glsl"
#if defined(NORMAL_MAP) || defined(MICROFACET)
#include "material.glsl"
#endif
#ifdef EMISSION_MAP
uniform sampler2D emission_map;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
#endif
#ifdef LAMPS
#include "lamps.glsl"
#include "lamplight.glsl"
#endif
#ifdef PROJECTOR
#include "projector.glsl"
#include "projection.glsl"
#endif
#endif
#if defined(TEXTURED) && (defined(COLOUR) || defined(ALPHA_TEST))
uniform sampler2D base_map;
#endif

void main() {
#ifdef ALPHA_TEST
    vec4 base = texture(base_map, v_uv);
    if (base.a < float(ALPHA_TEST) / 255.0) discard;
#endif
#if defined(COLOUR) || defined(RANGE)
    float range = length(v_position);
#endif
#ifdef COLOUR
    vec3 colour = v_base_colour;
#ifdef ALPHA_TEST
    colour *= base.rgb;
#elif defined(TEXTURED)
    colour *= texture(base_map, v_uv).rgb;
#endif
    float unit = inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    unit = gl_FrontFacing ? unit : -unit;
#ifdef NORMAL_MAP
    vec3 normal = mapped_normal(v_normal * unit);
    float facing = dot(normal, v_sun);
#else
    vec3 normal = v_normal * unit;
    float facing = v_terms.x * unit;
#endif
#ifdef PHYSICAL
    colour = albedo_of(colour);
#ifdef NORMAL_MAP
    float upward = dot(normal, v_up);
#else
    float upward = v_terms.w * unit;
#endif
#elif defined(NORMAL_MAP)
    float mirrored = (v_terms.y - 2.0 * facing * dot(normal, v_position)) / range;
#else
    float mirrored = (v_terms.y - 2.0 * facing * unit * dot(v_normal, v_position)) / range;
#endif
    float lit = 1.0;
#ifdef SHADOWS
    lit = sun_share(v_shadow_uv);
#endif
#ifdef FOG_CLIP
    float fog_range = v_terms.w;
#else
    float fog_range = range;
#endif
#ifdef MICROFACET
    prepare_material(colour, normal, v_terms.z);
    vec3 dry = material_daylight(normal, facing, upward, lit, v_terms.z);
#elif defined(PHYSICAL)
    vec3 dry = colour * daylight(facing, upward, lit, v_terms.z);
#else
    vec3 dry = sunlit(colour, facing, mirrored, lit);
#endif
#ifdef SKY
    if (v_terms.z < 0.0) dry = colour * skylight(normal, lit);
#endif
#ifdef LAMPS
    dry += lamplight(colour, normal);
#endif
#ifdef PROJECTOR
    dry = projected(dry, colour, normal);
#endif
#ifdef EMISSION
    vec3 emitted = v_emission;
#ifdef EMISSION_MAP
    emitted *= albedo_of(texture(emission_map, v_uv).rgb);
#endif
    dry += emitted;
#endif
#ifdef AIR
    float deeper = max(v_terms.z, v_camera_depth);
    float wet = clamp(deeper / max(deeper - min(v_terms.z, v_camera_depth), 1e-6), 0.0, 1.0);
    fog_range *= wet;
    float water_range = range * wet;
#else
    float water_range = range;
#endif
#ifdef OPACITY
    float opacity = float(OPACITY) / 255.0;
#else
    float opacity = 1.0;
#endif
#ifdef PHYSICAL
#ifdef OPACITY
    colour_out = vec4(dry, opacity);
#else
    colour_out = vec4(dry, water_range);  // the water follows in whole images: physical/development.py
#endif
#else
    colour_out = vec4(camera_colour(through_water(dry, water_range, fog_range, v_terms.z)), opacity);
#endif
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
`;var lc=`// Provides: the vertices of a model, in the camera frame and on the image.
// Needs: frame.glsl, instance.glsl, varyings.glsl, lamps.glsl, projector.glsl.
// Terms that are linear in space are computed here; their interpolation is exact.
#define VARYING out
#include "frame.glsl"
#include "instance.glsl"
#include "varyings.glsl"
#if defined(COLOUR) && defined(PHYSICAL)
#include "optics.glsl"
#ifdef CAUSTICS
#include "caustics_block.glsl"
#endif
#endif
#if defined(COLOUR) && defined(LAMPS)
#include "lamps.glsl"
#endif
#if defined(COLOUR) && defined(PROJECTOR)
#include "projector.glsl"
#endif

in vec3 vertex;
#ifdef COLOUR
in vec3 vertex_normal;
in vec3 tint;
#ifdef NORMAL_MAP
in vec4 tangent;
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
in vec3 finish;
#endif
#ifdef EMISSION
in vec3 emission;
#endif
#endif
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
in vec2 uv;
#endif

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    v_position = point.xyz;
    gl_Position = clip_from_camera * point;
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
    v_uv = uv;
#endif
#ifdef COLOUR
    v_normal = mat3(camera_normals) * vertex_normal;
    v_terms.x = dot(v_normal, sun.xyz);
    v_terms.y = dot(v_position, sun.xyz);
    v_terms.z = -(dot(v_position, up.xyz) + up.w);
#ifdef PHYSICAL
    v_terms.w = dot(v_normal, up.xyz);
#else
    v_terms.w = clip_fog.y - clip_fog.x * v_position.z;
#endif
    v_base_colour = tint;
    v_attenuation = attenuation.rgb;
#ifdef PHYSICAL
    v_sun_beam = vec4(sun_beam.rgb, upwelling.w);
    v_sun_loss = sun_loss.rgb;
    v_daylight_total = daylight_total.rgb;
    v_daylight_loss = daylight_loss.rgb;
    v_upwelling = upwelling.rgb;
#ifdef CAUSTICS
    v_caustic_place = vec2(dot(v_position, caustic_x.xyz), dot(v_position, caustic_y.xyz)) + vec2(caustic_x.w, caustic_y.w);
    v_caustic_depths = caustic_depths;
    v_swell_frame = swell_frame;
    v_caustic_loss = caustic_loss.rgb;
#endif
#else
    v_lights = vec4(sunlight.rgb, ambient_specular.x);
    v_water_colour = vec4(water_colour.rgb, ambient_specular.y);
    v_fog = fog;
#endif
#ifdef NORMAL_MAP
    mat3 rotation = mat3(camera_from_model);
    vec3 along = rotation * tangent.xyz;
    v_tangent = vec4(along * inversesqrt(max(dot(along, along), 1e-12)), tangent.w * sign(determinant(rotation)));
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
    v_sun = sun.xyz;
    v_up = up.xyz;
    v_finish = finish;
#endif
#ifdef EMISSION
    v_emission = emission;
#endif
#ifdef AIR
    v_camera_depth = -up.w;
#endif
#ifdef SHADOWS
#ifdef SOFT
    float lift = 2.5 * sun.w;  // look-ups are wider
#else
    float lift = sun.w;
#endif
    vec3 lifted = v_position + v_normal * (lift * inversesqrt(max(dot(v_normal, v_normal), 1e-12)));
    v_shadow_uv = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#endif
#ifdef LAMPS
    vec3 unit_normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float lift = lamp_light[i].w * dot(towards, lamp_axis[i].xyz) * sign(dot(unit_normal, towards));
        v_lamp_uv[i] = lamp_from_camera[i] * vec4(v_position + unit_normal * lift, 1.0);
    }
#endif
#ifdef PROJECTOR
    vec3 outwards = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    vec3 back = projector_position.xyz - v_position;
    float raise = projector_axis.w * dot(back, projector_axis.xyz) * sign(dot(outwards, back));
    v_projector_uv = projector_from_camera * vec4(v_position + outwards * raise, 1.0);
#endif
#endif
}
`;var cc=`// Provides: the requested outputs; the switches COLOUR, RANGE and IDS are their locations, or undefined.
// Needs: nothing.
// Colour: stored values 0..1. Range: along the ray [m], inf: no surface. Id 0: no surface.
#ifdef COLOUR
layout(location = COLOUR) out vec4 colour_out;
#endif
#ifdef RANGE
layout(location = RANGE) out float range_out;
#endif
#ifdef IDS
layout(location = IDS) out uint id_out;
#endif
`;var uc=`// Provides: direct(range) and whole_field(range), shares of light that arrives; weight(row, range), a share of scattered light.
// Needs: optics.glsl; the table of physical/blur_weights.py: row 0 is sharp light, row 1 + level that of a level of blur.
// Direct light is neither absorbed nor scattered; the whole field is that of a wide target. Formulas: optics/transmission.py.
uniform sampler2D weight_table;

vec3 direct(float range) {
    return exp((absorption.rgb + scattering.rgb) * -range);
}

vec3 whole_field(float range) {
    vec3 absorbed = absorption.rgb * range;
    vec3 wide_loss = scattering.w * sqrt(absorbed) + vec3(absorption.w);
    return exp(-absorbed - scattering.rgb * range * wide_loss);
}

vec3 weight(int row, float range) {
    vec2 size = vec2(textureSize(weight_table, 0));
    float share = range / (range + camera.z);
    return textureLod(weight_table, vec2((share * (size.x - 1.0) + 0.5) / size.x, (float(row) + 0.5) / size.y), 0.0).rgb;
}
`;var fc=`// Provides: the varyings of a surface; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, the number of lamps; those of material.glsl.
// Flat varyings pass on constants of the block Frame: llvmpipe reads them much faster than uniforms in each pixel.
#if defined(TEXTURED) || defined(NORMAL_MAP) || defined(FINISH_MAP) || defined(EMISSION_MAP)
#define HAS_UV
#endif
VARYING vec3 v_position;  // camera frame [m]
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
VARYING vec2 v_uv;  // texture coordinates
#endif
#ifdef COLOUR
VARYING vec3 v_normal;  // camera frame, any length
VARYING vec4 v_terms;  // x: N.L |N|; y: P.L [m] (L: to the sun, P: position); z: depth below the water's surface [m]; w: clip-space z [m], PHYSICAL: N.up |N|
flat VARYING vec3 v_base_colour;  // colour of the mesh
flat VARYING vec3 v_attenuation;  // attenuation of rgb [1/m]
#ifdef PHYSICAL
flat VARYING vec4 v_sun_beam;  // these are sun_beam, sun_loss ... of optics.glsl; w: upwelling.w
flat VARYING vec3 v_sun_loss;
flat VARYING vec3 v_daylight_total;
flat VARYING vec3 v_daylight_loss;
flat VARYING vec3 v_upwelling;
#ifdef CAUSTICS
VARYING vec2 v_caustic_place;  // where the sun's beam to the point enters the water [tiles]
flat VARYING vec4 v_caustic_depths;  // these are of caustics_block.glsl
flat VARYING vec4 v_swell_frame;
flat VARYING vec3 v_caustic_loss;
#endif
#else
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#endif
#ifdef NORMAL_MAP
VARYING vec4 v_tangent;  // xyz: camera frame; w: 1, or -1 where the texture is mirrored
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
flat VARYING vec3 v_sun;  // towards the sun, camera frame
flat VARYING vec3 v_up;  // W's z axis, camera frame
flat VARYING vec3 v_finish;  // x: roughness; y: share of metal; z: scale of the normal map
#endif
#ifdef EMISSION
flat VARYING vec3 v_emission;  // emitted radiance
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // homogeneous texture coordinates and depth in the lamps' shadow maps
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // homogeneous texture coordinates and depth in the projector's shadow map
#endif
#endif
`;var hc=`// Provides: through_water(lit, range, fog_range, depth), the colour of a surface at the camera.
// Needs: varyings.glsl; the switch NO_FOG if the fog density is 0; range: along the ray in water, fog_range: distance in
// the fog, depth: below the water's surface [m].
// lit E + w (1 - E exp(-0.001 depth)) with E = exp(-2 a range), then fog with exp(-(f fog_range)^2): see water.py.
vec3 through_water(vec3 lit, float range, float fog_range, float depth) {
    vec3 transmission = exp(v_attenuation * (-2.0 * range));
    float dimmed = exp(-0.001 * max(depth, 0.0));
    vec3 colour = transmission * (lit - v_water_colour.rgb * dimmed) + v_water_colour.rgb;
#ifdef NO_FOG
    return colour;
#else
    return mix(v_fog.rgb, colour, exp(-v_fog.w * fog_range * fog_range));
#endif
}
`;var mc=`// Provides: coverage D (J - B) of a particle, and its coverage as alpha; the renderer adds them up.
// Needs: optics.glsl, open_water.glsl; the outputs of particle.vert.glsl; the image of the surfaces.
// J: radiance of the particle, B: of open water behind it, D = exp(-c r). Nearer surfaces hide it.
#include "optics.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
flat in vec4 v_light;
flat in vec4 v_shape;
noperspective in vec2 v_offset;
out vec4 colour_out;

void main() {
    vec2 inner = v_offset / v_shape.xy;
    float square = dot(inner, inner);
    float inside = 1.0 - square;
    if (inside <= 0.0) discard;
    float range = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0).a;
    if (range < v_light.a) discard;
    float profile = 3.0 * inside * inside;
    // the rim of a bubble is seen if its image is large enough
    if (v_shape.w > 0.5) profile = mix(profile, 30.0 * square * square * inside * inside, clamp(0.5 * v_shape.y - 1.0, 0.0, 0.85));
    float coverage = min(v_shape.z * profile, 1.0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(textureSize(surface_image, 0)));
    vec3 direct = exp((absorption.rgb + scattering.rgb) * -v_light.a);
    colour_out = vec4(coverage * direct * (v_light.rgb - water), coverage);
}
`;var dc=`// Provides: the rectangle around the image of a particle, and the particle's radiance.
// Needs: frame.glsl, optics.glsl, particle_lens.glsl; lamps.glsl with LAMPS; four vertices for each instance, a record of PARTICLE.
// The radiance is rho (E_sun + 2 E_down + 2 E_up + sum of E_lamp): physical/particle_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "particle_lens.glsl"
#ifdef LAMPS
#include "lamps.glsl"
uniform sampler2DShadow lamp_maps;
#endif
uniform sampler2D surface_image;
in vec4 place;   // xyz: camera frame [m]; w: radius [m]
in vec4 extent;  // xyz: motion during the exposure and own length, camera frame [m]; w: share that is drawn
in vec2 traits;  // x: reflectance; y: kind
flat out vec4 v_light;   // rgb: radiance; a: range [m]
flat out vec4 v_shape;   // x, y: half the length and the width [px]; z: coverage; w: kind
noperspective out vec2 v_offset;  // along and across the streak [px]

vec2 pixel_of(vec3 point) {
    vec2 slope = point.xy / max(-point.z, 0.01) - ray_first.xy;
    float row = slope.y / ray_row.y;
    return vec2((slope.x - row * ray_row.x) / ray_column.x, row);
}

vec3 lit(vec3 point) {
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 total = daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 level = min(sun_beam.rgb * exp(sun_loss.rgb * -z), total);
    vec3 sum = level / upwelling.w + 2.0 * (total - level) + 2.0 * upwelling.rgb * total;
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), 0.03);
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        float share = 1.0;
        if (lamp_position[i].w > -1.0) {
            vec4 uv = lamp_from_camera[i] * vec4(point, 1.0);
            share = cone > 0.0 ? textureLod(lamp_maps, uv.xyz / uv.w, 0.0) : 0.0;
        } else {
            cone = 1.0;
        }
        vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
        vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
        sum += lamp_light[i].rgb * transmission * (cone * cone * (3.0 - 2.0 * cone) * share / (distance * distance));
    }
#endif
    return sum;
}

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    float range = length(place.xyz);
    float depth = max(-place.z, 0.01);
    vec2 first = pixel_of(place.xyz - 0.5 * extent.xyz);
    vec2 last = pixel_of(place.xyz + 0.5 * extent.xyz);
    vec2 streak = last - first;
    float streak_length = min(length(streak), 0.5 * size.x);
    vec2 along = streak_length > 0.01 ? normalize(streak) : vec2(1.0, 0.0);
    float focal = inversesqrt(abs(ray_column.x * ray_row.y));
    float radius = place.w * focal / depth;
    float blur = particle_lens.x * focal * abs(1.0 / depth - particle_lens.y);
    float drawn = max(1.7320508 * sqrt(radius * radius + blur * blur), particle_lens.z);
    float coverage = extent.w * radius * radius / (drawn * (drawn + 0.5 * streak_length));
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    v_offset = corner * vec2(0.5 * streak_length + drawn, drawn);
    v_light = vec4(traits.x * lit(place.xyz), range);
    v_shape = vec4(0.5 * streak_length + drawn, drawn, coverage, traits.y);
    vec2 pixel = 0.5 * (first + last) + v_offset.x * along + v_offset.y * vec2(-along.y, along.x);
    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
}
`;var pc=`// Provides: the block ParticleLens, the lens through which particles are seen.
// Needs: nothing. Filled by physical/particle_pass.py, where the same members are declared.
// A lens with the aperture A, focused at the distance F, blurs a point at r by A |1/r - 1/F|.
layout(std140) uniform ParticleLens {
    vec4 particle_lens;  // x: radius of the aperture [m]; y: 1 / distance of the focus [1/m]; z: least radius of an image [px]
};
`;var gc=`// Provides: a finished image at its place on the page; an image twice as wide and high becomes the mean of its squares of four.
// Needs: presented.vert.glsl; the image, row 0 at the top, with linear interpolation.
in vec2 v_uv;
uniform sampler2D level_0;
out vec4 colour_out;

void main() {
    colour_out = textureLod(level_0, v_uv, 0.0);
}
`;var vc=`// Provides: one triangle over the whole target, and the texture coordinates of its pixels.
// Needs: nothing; three vertices without attributes. With the switch FLIPPED, row 0 of the target is the lowest one of the image.
out vec2 v_uv;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_uv = 0.5 * corner + 0.5;
#ifdef FLIPPED
    v_uv.y = 1.0 - v_uv.y;
#endif
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var zm={"background.frag.glsl":Il,"background.vert.glsl":Fl,"blurred.frag.glsl":Cl,"blurred_rows.frag.glsl":Ol,"caustics.glsl":Nl,"caustics_block.glsl":Dl,"daylight.glsl":Ul,"developed.frag.glsl":Hl,"frame.glsl":Vl,"gaussian.glsl":Bl,"grey.glsl":Gl,"instance.glsl":Wl,"lamp_point.frag.glsl":zl,"lamp_point.vert.glsl":jl,"lamp_veil.glsl":Yl,"lamplight.glsl":ql,"lamps.glsl":Xl,"material.glsl":$l,"open_water.glsl":Kl,"optics.glsl":Ql,"particle.frag.glsl":mc,"particle.vert.glsl":dc,"particle_lens.glsl":pc,"presented.frag.glsl":gc,"presented.vert.glsl":vc,"projection.glsl":Jl,"projector.glsl":Zl,"reduced.frag.glsl":ec,"scattered.frag.glsl":tc,"screen.vert.glsl":rc,"shadow.frag.glsl":nc,"shadow.glsl":sc,"shadow.vert.glsl":ic,"sun.glsl":oc,"surface.frag.glsl":ac,"surface.vert.glsl":lc,"targets.glsl":cc,"transmission.glsl":uc,"varyings.glsl":fc,"water.glsl":hc},jm=`#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DShadow;
#define noperspective
`,yr={Frame:0,Instance:1,Lamps:2,Projector:3,Optics:4,ParticleLens:9},he={base_map:0,shadow_map:1,lamp_maps:2,projector_map:3,projector_pattern:4,open_water_map:5,weight_table:6,level_0:7,level_1:8,level_2:9,level_3:10,level_4:15,level_5:16,surface_image:17,normal_map:11,finish_map:12,emission_map:13,reflectance_table:14,particle_image:18},hs={vertex:0,vertex_normal:1,uv:2,tint:3,tangent:4,finish:5,emission:6,place:8,extent:9,traits:10},fs=class{constructor(e){this.gl=e}gl;programs=new Map;get(e,n,r=e){let s=e+JSON.stringify(n),i=this.programs.get(s);return i||this.programs.set(s,i=Ym(this.gl,e,n,r)),i}};function bc(t,e){if(e.has(t))return"";e.add(t);let n=zm[t];return n===void 0?`#error no shader file ${t}`:n.replace(/^#include "([\w.]+)"$/gm,(r,s)=>bc(s,e))}function Ym(t,e,n,r){let s=Object.entries(n).map(([o,a])=>`#define ${o} ${a}
`),i=t.createProgram();for(let[o,a]of[[t.VERTEX_SHADER,`${r}.vert.glsl`],[t.FRAGMENT_SHADER,`${e}.frag.glsl`]]){let l=t.createShader(o);t.shaderSource(l,jm+s.join("")+bc(a,new Set)),t.compileShader(l),t.attachShader(i,l)}for(let[o,a]of Object.entries(hs))t.bindAttribLocation(i,a,o);if(t.linkProgram(i),!t.getProgramParameter(i,t.LINK_STATUS)){let o=(t.getAttachedShaders(i)??[]).map(a=>t.getShaderInfoLog(a));throw new Error(`${e}: ${t.getProgramInfoLog(i)} ${o.join(" ")}`)}t.useProgram(i);for(let[o,a]of Object.entries(yr)){let l=t.getUniformBlockIndex(i,o);l!==t.INVALID_INDEX&&t.uniformBlockBinding(i,l,a)}for(let[o,a]of Object.entries(he))t.uniform1i(t.getUniformLocation(i,o),a);return i}var yc={normal_map:"NORMAL_MAP",finish_map:"FINISH_MAP",emission_map:"EMISSION_MAP"},_c=32,qm=[["tangent","tangents",4,"SHORT"],["finish","finish",3,"FLOAT"],["emission","emissions",3,"FLOAT"]];function Xm(t,e,n){let r={};return"normal_map"in t.maps&&(r.NORMAL_MAP=1),e&&(r.MICROFACET=1,"finish_map"in t.maps&&(r.FINISH_MAP=1),t.emits&&(r.EMISSION=1),t.emits&&"emission_map"in t.maps&&(r.EMISSION_MAP=1)),n&&t.cutoff!==null&&(r.ALPHA_TEST=Math.max(1,Math.min(255,Math.round(255*t.cutoff)))),r}function wc(t,e){for(let[n,r,s,i]of qm){let o=t[r];o&&e(n,s,i,o)}}var ms=class{constructor(e,n,r,s){this.gl=e;this.images=r;this.textures=s;this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(o=>{let a=e.createSampler();return e.samplerParameteri(a,e.TEXTURE_MIN_FILTER,e.LINEAR_MIPMAP_NEAREST),e.samplerParameteri(a,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_WRAP_S,o),e.samplerParameteri(a,e.TEXTURE_WRAP_T,o),a});let{reflectance:i}=n.head;this.table=i?$m(e,n.numbers(i)):null}gl;images;textures;samplers;table;use(e,n,r){if(!e)return n;let s=this.gl,i={...n,...Xm(e,"PHYSICAL"in n,"TEXTURED"in n)};for(let[o,a]of Object.entries(e.maps)){if(!(yc[o]in i))continue;let l=Number(this.textures[a].repeats);this.bindTexture(he[o],this.images[a]),s.bindSampler(he[o],(r??this.samplers)[l])}return i.MICROFACET&&this.table&&this.bindTexture(he.reflectance_table,this.table),i}release(){for(let e of Object.keys(yc))this.gl.bindSampler(he[e],null)}bindTexture(e,n){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,n),this.gl.activeTexture(this.gl.TEXTURE0)}};function $m(t,e){let n=t.createTexture();t.bindTexture(t.TEXTURE_2D,n),t.texImage2D(t.TEXTURE_2D,0,t.RGBA16F,_c,_c,0,t.RGBA,t.FLOAT,e);for(let r of[t.TEXTURE_WRAP_S,t.TEXTURE_WRAP_T])t.texParameteri(t.TEXTURE_2D,r,t.CLAMP_TO_EDGE);for(let r of[t.TEXTURE_MIN_FILTER,t.TEXTURE_MAG_FILTER])t.texParameteri(t.TEXTURE_2D,r,t.LINEAR);return n}var Yi=class{constructor(e,n,r,s,i,o,a,l){this.index=e;this.visual=n;this.body=r;this.vertexArray=s;this.texture=i;this.repeats=o;this.hasUint32Indices=a;this.pieceRows=l;this.bodyFromMesh=Le(n.matrix),this.pieces=l.map(([u,d])=>({instance:this,firstIndex:u,count:d,centre:[0,0,0],radius:0,corners:[],normal:[0,0,0],density:0}))}index;visual;body;vertexArray;texture;repeats;hasUint32Indices;pieceRows;pieces;worldFromMesh=Le(new Array(16).fill(0));normals=this.worldFromMesh;isMirrored=!1;bodyFromMesh;place(e){let n=Ie(e,this.bodyFromMesh);if(n.every((i,o)=>i===this.worldFromMesh[o]))return!1;this.worldFromMesh=n,this.normals=Oo(n),this.isMirrored=ei(n)<0;let[r,s]=[xc(n),xc(this.normals)];return this.pieceRows.forEach((i,o)=>{let a=this.pieces[o];a.centre=Pe(n,i.slice(2,5)),a.radius=i[5]*r;let l=[i.slice(6,9),i.slice(9,12)];a.corners=[0,1,2,3,4,5,6,7].map(d=>Pe(n,[l[d>>2][0],l[d>>1&1][1],l[d&1][2]]));let u=i.slice(12,15);a.normal=me(u,u)>0?_t(Fn(this.normals,u)):[0,0,0],a.density=i[15]*s}),!0}};function xc(t){let e=[0,1,2].map(r=>[t[r],t[4+r],t[8+r]]),n=e.map(r=>e.reduce((s,i)=>s+Math.abs(me(r,i)),0));return Math.sqrt(Math.max(...n))}var ds=class t{constructor(e,n){this.head=e;this.gl=n}head;gl;instances=[];version=0;patterns=[];maps=null;bodies=new Map;radii=new Map;sand=[];static async load(e,n){let r=new t(n.head,e);if(r.place(new Map),!e)return r;let{meshes:s,textures:i,bodies:o,projector:a}=n.head,l=await Promise.all(i.map(({repeats:h},p)=>Qm(e,n,p,p!==a?.pattern&&h)));a&&r.patterns.push(l[a.pattern]),r.maps=new ms(e,n,l,i);let u=s.map((h,p)=>Km(e,n,p)),d=u.map(({vertexArray:h})=>h);for(let h of n.head.sand??[]){let p=n.numbers(s[h.mesh].positions);r.sand.push({heap:new us(h,p),...u[h.mesh]})}for(let h of o)for(let p of h.visuals){let{texture:b,mesh:_}=p,w=b===null?null:l[b],S=b!==null&&i[b].repeats,T=s[_].triangles[2]==="u4",[x,A]=[r.instances.length,s[_].pieces];r.instances.push(new Yi(x,p,h.name,d[_],w,S,T,A))}return r.place(new Map),r}place(e){for(let r of this.head.bodies)this.bodies.set(r.name,e.get(r.name)??st(r.pose));let n=!1;for(let r of this.instances)n=r.place(this.body(r.body))||n;n&&(this.version+=1,this.computeRadii())}setSand(e,n){let{gl:r}=this,{heap:s,positions:i,normals:o}=this.sand[e]??{};if(!r||!s||!i||!o||!(n instanceof Float32Array?s.set(n):s.apply(n)))return;let a=s.surface();r.bindBuffer(r.ARRAY_BUFFER,i),r.bufferData(r.ARRAY_BUFFER,a.positions,r.STATIC_DRAW),r.bindBuffer(r.ARRAY_BUFFER,o),r.bufferData(r.ARRAY_BUFFER,a.normals,r.STATIC_DRAW),this.version+=1}heights(e){return this.sand[e]?.heap.heights??new Float32Array}body(e){return this.bodies.get(e)??st([0,0,0,1,0,0,0])}worldFromMount(e){let n=st(e.pose);return e.body===null?n:Ie(this.body(e.body),n)}radius(e){return this.radii.get(e.visual.part)??0}computeRadii(){let e=new Map;for(let{visual:n,pieces:r}of this.instances){let s=e.get(n.part)??[1/0,1/0,1/0,-1/0,-1/0,-1/0];for(let{centre:i,radius:o}of r)for(let a=0;a<3;++a)s[a]=Math.min(s[a],i[a]-o),s[3+a]=Math.max(s[3+a],i[a]+o);e.set(n.part,s)}for(let[n,r]of e)this.radii.set(n,Math.max(r[3]-r[0],r[4]-r[1],r[5]-r[2])/2)}};function Km(t,e,n){let r=e.head.meshes[n],s=t.createVertexArray();t.bindVertexArray(s);let i=(u,d,h,p)=>{let b=t.createBuffer();return t.bindBuffer(t.ARRAY_BUFFER,b),t.bufferData(t.ARRAY_BUFFER,p,t.STATIC_DRAW),t.enableVertexAttribArray(hs[u]),t.vertexAttribPointer(hs[u],d,h,h!==t.FLOAT,0,0),b},o=u=>e.numbers(u),a=i("vertex",3,t.FLOAT,o(r.positions)),l=i("vertex_normal",3,t.SHORT,o(r.normals));return i("tint",3,t.UNSIGNED_SHORT,o(r.tints)),r.uvs&&i("uv",2,t.FLOAT,o(r.uvs)),wc(r,(u,d,h,p)=>i(u,d,t[h],o(p))),t.bindBuffer(t.ELEMENT_ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ELEMENT_ARRAY_BUFFER,o(r.triangles),t.STATIC_DRAW),t.bindVertexArray(null),{vertexArray:s,positions:a,normals:l}}async function Qm(t,e,n,r){let{type:s,bytes:i}=e.head.textures[n],o=n===e.head.projector?.pattern,a=await createImageBitmap(new Blob([e.numbers(i)],{type:s}),{imageOrientation:o?"from-image":"flipY",premultiplyAlpha:"none",colorSpaceConversion:"none"}),l=t.createTexture();t.bindTexture(t.TEXTURE_2D,l),t.texImage2D(t.TEXTURE_2D,0,t.RGBA8,t.RGBA,t.UNSIGNED_BYTE,a);let u=r?t.REPEAT:t.CLAMP_TO_EDGE;return t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,u),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,u),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,t.LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,o?t.LINEAR:t.LINEAR_MIPMAP_LINEAR),o||t.generateMipmap(t.TEXTURE_2D),a.close(),l}var Jm=["#ff5a4f","#45d96b","#4aa3ff"],bn=.02,vn=11,Zm=[0,1,-1,2,-2,3,-3,4,-4,5,-5],qi=class{constructor(e,n,r){this.context=e;this.intrinsics=r;this.cameraFromWorld=ut(n)}context;intrinsics;labelBoxes=[];cameraFromWorld;line(e,n,r=1.5,s=[]){let{context:i}=this;i.strokeStyle=n,i.lineWidth=r,i.setLineDash(s),i.beginPath();let o=null;for(let a of e){let l=Pe(this.cameraFromWorld,a);if(o&&(o[2]<-bn||l[2]<-bn)){let[u,d]=[Ec(o,l),Ec(l,o)];i.moveTo(...this.pixel(u)),i.lineTo(...this.pixel(d))}o=l}i.stroke()}project(e){let n=Pe(this.cameraFromWorld,e);return n[2]<-bn?this.pixel(n):null}label(e,n,r="#ffffff"){let s=this.project(e);if(!s)return;let{context:i}=this;i.font=`${vn}px system-ui, sans-serif`;let o=this.findSpot(s,i.measureText(n).width);if(!o)return;let[a,l]=o;Math.abs(l-s[1])>2*vn&&this.drawLeader(s,[a-2,l-vn/3],r),i.lineWidth=3,i.setLineDash([]),i.strokeStyle="rgba(0, 12, 24, 0.75)",i.strokeText(n,a,l),i.fillStyle=r,i.fillText(n,a,l)}findSpot([e,n],r){for(let s of Zm)for(let i of[e+5,e-5-r]){let o=n-5+s*(vn+3),a=[i-2,o-vn,i+r+2,o+3];if(!this.labelBoxes.some(l=>a[0]<l[2]&&a[2]>l[0]&&a[1]<l[3]&&a[3]>l[1]))return this.labelBoxes.push(a),[i,o]}return null}drawLeader(e,n,r){let{context:s}=this;s.strokeStyle=r,s.lineWidth=.75,s.setLineDash([]),s.beginPath(),s.moveTo(...e),s.lineTo(...n),s.stroke()}dot(e,n,r){let s=this.project(e);s&&(this.context.fillStyle=n,this.context.beginPath(),this.context.arc(s[0],s[1],r,0,2*Math.PI),this.context.fill())}pixel([e,n,r]){let{fx:s,fy:i,cx:o,cy:a,skew:l}=this.intrinsics;return[o+(s*e+l*n)/-r+.5,a-i*n/-r+.5]}};function Ec(t,e){if(t[2]<-bn)return t;let n=(-bn-t[2])/(e[2]-t[2]);return t.map((r,s)=>r+n*(e[s]-r))}function Mc(t,e,n,r,s,i,o,a){let l=new qi(t,e,n);for(let{name:u,at:d,colour:h,lines:p}of i.markers(o.time)){for(let b of p)l.line(b,h);p.length||l.dot(d,h,3),(a.labels||!p.length)&&l.label(d,u)}if(a.trails&&ed(l,r,i,o),a.sonars)for(let u of r.sensors)rd(l,u,s.worldFromMount(u),o);if(a.frames)td(l,r,s,a.labels);else if(a.labels)for(let{name:u,body:d}of r.vehicles)l.label(Re(s.body(d)),u);for(let u of o.points("contacts",["x","y","z"]))l.dot(u,"#ffb02e",4);for(let{name:u,body:d}of r.vehicles)nd(l,u,s.body(d),o)}function ed(t,e,n,r){let s=e.vehicles.map(({body:o})=>o),i=e.bodies.filter(o=>o.vehicle===null).map(({name:o})=>o);for(let o of[...s,...i]){let a=r.poses.get(o);if(!a)continue;let l=n.trail(o,r.time);t.line([...l,Re(a)],"rgba(255, 214, 92, 0.9)",1.5)}}function td(t,e,n,r){let s=e.vehicles.length>1,i=new Map(e.bodies.map(({name:o,vehicle:a})=>[o,a??""]));for(let{name:o,body:a,pose:l}of e.frames){let u=n.worldFromMount({body:a,pose:l}),d=a===null?1:.25;Jm.forEach((p,b)=>{let _=[0,1,2].map(w=>w===b?d:0);t.line([Re(u),Pe(u,_)],p,2)});let h=s&&a!==null?`${i.get(a)} `:"";r&&t.label(Re(u),h+o.split("/").at(-1))}}function rd(t,e,n,r){let s="rgba(120, 220, 255, 0.8)",i=r.signal(`range/${e.name}`);if(e.kind==="range"){let l=i??e.reach,u=Pe(n,[l,0,0]);t.line([Re(n),u],s,1.5,i===void 0?[4,4]:[]),i!==void 0&&t.dot(u,"#78dcff",3),i!==void 0&&t.label(u,`${i.toFixed(2)} m`,"#bfeeff");return}let o=l=>e.kind==="fan"?[0,Math.sin(l),-Math.cos(l)]:[Math.cos(l),Math.sin(l),0],a=Array.from({length:33},(l,u)=>{let d=e.from+(e.to-e.from)*u/32;return Pe(n,o(d).map(h=>h*e.reach))});t.line([Re(n),...a,Re(n)],s,1)}function nd(t,e,n,r){let s=["x","y","z"].map(d=>r.signal(`water/${e}/${d}`)??0),i=Math.hypot(...s);if(i<.005)return;let o=Me(Re(n),[0,0,.55]),a=Me(o,s,(.5+2*i)/i),l=[-s[1]/i,s[0]/i,0],u=Me(a,s,-.15/i);t.line([o,a],"#5ee6d0",2.5),t.line([Me(u,l,.08),a,Me(u,l,-.08)],"#5ee6d0",2.5),t.label(a,`current ${i.toFixed(2)} m/s`,"#b9fff1")}function Xi(t,e,n,r,s,i){let o=n.fx/e.fx;for(let[a,l,u]of[["truth","#45f08b",[]],["estimate","#ff9f43",[6,4]]]){let d=i.points(`${a}/${e.name}`,["u","v"]);if(!(d.length<2)){t.strokeStyle=l,t.lineWidth=2,t.setLineDash([...u]),t.beginPath();for(let[h,p]of d)t.lineTo(r+n.cx+(h-e.cx)*o+.5,s+n.cy+(p-e.cy)*o+.5);t.closePath(),t.stroke(),t.setLineDash([])}}}function Sc(t,e,n,r){let[s,i]=[28,r+22],o=sd(130*n/e.fx),a=o*e.fx/n;t.save(),t.setLineDash([]),t.shadowColor="rgba(0, 12, 24, 0.9)",t.shadowBlur=3,t.fillStyle=t.strokeStyle="#ffffff",t.textAlign="center",t.font="600 13px system-ui, sans-serif",t.fillText("N",s,i),t.beginPath(),t.moveTo(s,i+6),t.lineTo(s+8,i+28),t.lineTo(s,i+23),t.lineTo(s-8,i+28),t.closePath(),t.fill();let[l,u]=[18,i+58];t.lineWidth=2,t.beginPath(),t.moveTo(l,u-6),t.lineTo(l,u),t.lineTo(l+a,u),t.lineTo(l+a,u-6),t.stroke(),t.fillText(o<1?`${Math.round(100*o)} cm`:`${o} m`,l+a/2,u-8),t.restore()}function sd(t){let e=10**Math.floor(Math.log10(t)),n=[5,2,1].find(r=>r*e<=t*(1+1e-9))??1;return Number((n*e).toPrecision(1))}var id=.3,$i=.05,od=Math.SQRT2,Qi=Le([.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1]);function ad(t){let e=[0,4,8,12].map(r=>[t[r],t[r+1],t[r+2],t[r+3]]);return[1,-1].flatMap(r=>[0,1,2].map(s=>e[3].map((i,o)=>i+r*e[s][o]))).map(r=>{let s=Math.hypot(r[0],r[1],r[2]);return r.map(i=>i/s)})}function ps(t,e){let n=ad(e.clip),r=ut(e.worldFromCamera),s=[];for(let i of t){let o=Pe(r,i.centre);if(!n.every(l=>me(l,o)+l[3]+i.radius>0))continue;let a=i.corners.map(l=>Pe(r,l));n.every(l=>a.some(u=>me(l,u)+l[3]>0))&&s.push([Math.hypot(...o)+i.radius,i])}return s.sort((i,o)=>i[0]-o[0]).map(([,i])=>i)}function Ac(t,e,n,r){let s=ld(n),i=Re(r.worldFromCamera),o=[r.worldFromCamera[2],r.worldFromCamera[6],r.worldFromCamera[10]],a=cd(r),l=e.map(u=>{let d=u.corners.map(w=>me(Me(i,w,-1),o)),p=[Math.max(0,Math.min(...d)),Math.max(0,Math.max(...d))].flatMap(w=>a.map(S=>Me(i,S,w))),[b,_]=[Ki(u.corners,s),Ki(p,s)];return b.map(([w,S],T)=>[Math.max(w,_[T][0]),Math.min(S,_[T][1])])});return t.filter(u=>{let d=Ki(u.corners,s);return l.some(h=>[0,1].every(p=>d[p][0]<=h[p][1]+$i&&d[p][1]>=h[p][0]-$i)&&d[2][1]>=h[2][0]-$i)})}function ld(t){return t[2]<id?[...Tc(t),t]:[[1,0,-t[0]/t[2]],[0,1,-t[1]/t[2]],t]}function Ki(t,e){return e.map(n=>{let r=t.map(s=>me(n,s));return[Math.min(...r),Math.max(...r)]})}function cd({clip:t,worldFromCamera:e}){return[[-1,-1],[-1,1],[1,-1],[1,1]].map(([r,s])=>{let i=(s+t[6])/t[5],o=(r+t[2]-t[1]*i)/t[0];return[e[0]*o+e[1]*i-e[2],e[4]*o+e[5]*i-e[6],e[8]*o+e[9]*i-e[10]]})}function Tc(t){let e=[-t[0],-t[1],-t[2]],n=_t(nt(e,Math.abs(t[2])<.9?[0,0,1]:[1,0,0]));return[n,nt(n,e)]}function Rc(t,e){let n=[...Tc(e),[-e[0],-e[1],-e[2]]],r=[1/0,1/0,1/0],s=[-1/0,-1/0,-1/0];for(let{centre:d,radius:h}of t)n.forEach((p,b)=>{r[b]=Math.min(r[b],me(p,d)-h),s[b]=Math.max(s[b],me(p,d)+h)});let i=Math.max(s[0]-r[0],s[1]-r[1])/2,o=20,a=[1/i,1/i,2/(s[2]+o-r[2])],l=[(r[0]+s[0])/2,(r[1]+s[1])/2,(s[2]+o+r[2])/2],u=n.flatMap((d,h)=>[d[0]*a[h],d[1]*a[h],d[2]*a[h],-a[h]*l[h]]);return[Le([...u,0,0,0,1]),2*i]}function Lc(t,e){if(!(t.density>0)||me(t.normal,t.normal)===0)return!1;let n=ut(e.worldFromCamera),r=t.corners.map(h=>Pe(n,h)),s=Cn(e.worldFromCamera,t.normal),i=r.map(h=>-h[2]);if(Math.min(...i)<=0)return!1;let o=Math.min(...r.map(h=>Math.abs(me(s,h)))),a=Math.max(...r.map(h=>Math.hypot(...h))),l=Math.hypot(s[0],s[1]),u=Math.min(e.intrinsics.fx,e.intrinsics.fy),d=Math.max(...i)/u*(1+l*a/o);return t.density*d<=od}var gs=512,Pc=1024,ud=.008,It=512,fd=80*Math.PI/180,kc=1.02,hd=1024,yn=class{constructor(e,n,r){this.gl=e;this.width=n;this.height=r;this.texture=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.texture),e.texStorage2D(e.TEXTURE_2D,1,e.DEPTH_COMPONENT24,n,r);for(let[s,i]of[[e.TEXTURE_COMPARE_MODE,e.COMPARE_REF_TO_TEXTURE],[e.TEXTURE_COMPARE_FUNC,e.LEQUAL],[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D,s,i);this.buffer=e.createFramebuffer(),e.bindFramebuffer(e.FRAMEBUFFER,this.buffer),e.framebufferTexture2D(e.FRAMEBUFFER,e.DEPTH_ATTACHMENT,e.TEXTURE_2D,this.texture,0),e.drawBuffers([e.NONE]),this.begin(0,0,n,r)}gl;width;height;texture;buffer;begin(e,n,r,s){let i=this.gl;i.bindFramebuffer(i.FRAMEBUFFER,this.buffer),i.viewport(e,n,r,s),i.enable(i.SCISSOR_TEST),i.scissor(e,n,r,s),i.depthMask(!0),i.clearDepth(1),i.clear(i.DEPTH_BUFFER_BIT),i.disable(i.SCISSOR_TEST)}},vs=class{constructor(e,n,r){this.gl=e;this.programs=n;this.instanceBlocks=r;let s=[gs,Pc].map(i=>[i,new yn(e,i,i)]);this.suns=Object.fromEntries(s),this.sunMap=this.suns[gs]}gl;programs;instanceBlocks;suns;sunMap;textureFromWorld=Le([1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]);lift=0;lampMaps=null;projectorMap=null;sunKey="";lampKeys=[];updateSunShadows(e,n,r){let s=`${r} ${n} ${e.map(l=>`${l.instance.index}.${l.firstIndex}`)}`;if(s===this.sunKey)return;this.sunKey=s;let[i,o]=Rc(e,n),a=o/gs<=ud?gs:Pc;this.sunMap=this.suns[a],this.textureFromWorld=Ie(Qi,i),this.lift=1.5*o/a,this.sunMap.begin(0,0,a,a),this.draw(e,i)}updateLampShadows(e,n,r){this.lampMaps??=new yn(this.gl,2*It,2*It),e.forEach(({lamp:s,worldFromLamp:i},o)=>{let a=s.shadow?`${r} ${s.half_angle} ${i}`:"none";if(a===this.lampKeys[o])return;this.lampKeys[o]=a;let[l,u]=[o%2,o>>1];this.lampMaps.begin(It*l,It*u,It,It),s.shadow&&this.drawShadowMap(i,Ic(s),n)})}updateProjectorShadows(e,n,r){this.projectorMap??=new yn(this.gl,n.width,n.height),this.projectorMap.begin(0,0,n.width,n.height),this.drawShadowMap(e,n,r)}drawShadowMap(e,n,r){let s=Hr(n,!0),i=ps(r,{worldFromCamera:e,clip:s,intrinsics:n});this.draw(i.filter(_n),Ie(s,ut(e)),!0)}draw(e,n,r=!1){let s=this.gl;s.enable(s.DEPTH_TEST),s.depthFunc(s.LEQUAL),s.enable(s.POLYGON_OFFSET_FILL),s.polygonOffset(1.5,2),s.useProgram(this.programs.get("shadow",{})),this.instanceBlocks.fill(n);for(let i of e)this.instanceBlocks.drawPiece(i,r);s.disable(s.POLYGON_OFFSET_FILL)}};function _n(t){return t.instance.visual.opacity>=1}function Ic(t){let e=It/2/(kc*Math.tan(Math.min(t.half_angle,fd))),n=(It-1)/2,[r,s]=[It,It];return{width:r,height:s,fx:e,fy:e,cx:n,cy:n,skew:0,near:.1,far:20}}function Fc(t,e,n){let r=hd/Math.max(n,e),s=Math.max(1,Math.round(r*e)),i=Math.max(1,Math.round(r*n)),o=Math.tan(t.fovy/2);return{width:s,height:i,fx:s/2/(o*e/n),fy:i/2/o,cx:(s-1)/2,cy:(i-1)/2,skew:0,near:.1,far:20}}function Cc(t,e){let n=new Float32Array(112),r=ut(e);return t.forEach(({lamp:s,worldFromLamp:i},o)=>{let[a,l]=[.25+.5*(o%2),.25+.5*(o>>1)],u=Le([.25,0,0,a,0,.25,0,l,0,0,.5,.5,0,0,0,1]),d=Ie(u,Hr(Ic(s),!0));n.set(zt(Ie(Ie(d,ut(i)),e)),16*o);let h=Ie(r,i),p=Math.cos(s.half_angle),b=Math.cos((1-s.softness)*s.half_angle),_=2*kc*Math.tan(s.half_angle)/It,w=h;n.set([...Re(w),p],64+4*o),n.set([w[2],w[6],w[10],1/Math.max(b-p,1e-5)],80+4*o),n.set([...s.colour.map(S=>S*s.intensity),1.5*_],96+4*o)}),n}function Oc(t,e,n,r){let s=Ie(ut(e),r),i=Ie(Qi,Hr(n,!0)),o=ut(s);return Float32Array.from([...zt(Ie(i,s)),...Re(o),t.laser?1:0,o[2],o[6],o[10],1.5/Math.min(n.fx,n.fy)])}function Nc(t,e,n,r,s){let{fx:i,fy:o,cx:a,cy:l,skew:u}=e,[d,h]=[1/i,-1/o],p=u*h/i,b=h*(-.5-l),_=d*(-.5-a)-u*b/i,w=T=>T.map(x=>r*x),S=new Float32Array(76);return S.set([...t.absorption,t.field[0],...t.scattering,t.field[1],...Array.from({length:8},(T,x)=>s[x]??0),0,t.exposure,t.scale,0,...w(t.beam),0,...t.beam_loss,0,...w(t.total),0,...t.loss,0,...t.reflectance,t.sun[2],...t.phase,_,b,-1,0,d,0,0,0,-p,h,0,0]),n.forEach(({lamp:T,index:x},A)=>{let M=Math.cos(T.half_angle);S.set([...t.lamps[x],M*M,+(T.half_angle<Math.PI/2)],4*(15+A))}),S}var[md,dd]=[.0625,.1875],pd=.1875,gd=24;function Dc(t,e,n){let r=Math.sqrt(t.fx*t.fy),s=Math.min(Math.round(Math.log(Math.max(.41*r,1))/Math.log(2.6)),7);if(!n||s<1)return{deviations:[],spreads:[],reach:[],highestFrequency:120};let i=(.41*r)**(1/s),o=Array.from({length:s+1},(l,u)=>i**u),a=o.map(l=>l/r);return{deviations:a,spreads:o.map(bd),reach:a.map(l=>vd(l,e,t)),highestFrequency:Math.min(120,.3*r)}}function Uc(t){return{RADIUS:Hc(t),SPREAD:Math.round(1e3*t)}}function Hc(t){return t>0?Math.min(Math.ceil(3*t),gd):0}function vd(t,e,n){let[r,s]=[n.width/n.fx/2,n.height/n.fy/2],i=[r,s].map(a=>e.map(l=>Math.min(t*l,a)**2)),o=0;for(let a of i[0])for(let l of i[1])o+=Math.sqrt(1+a+l);return e.length**2/o}function bd(t,e){let[n,r]=[0,0];for(let i=0;i<=e;++i)n=n/4+(i<2?md:dd),r=r/4+pd;let s=(t/2**(e+1))**2-n-r;return s>.01?yd(s):0}function yd(t){let[e,n]=[.1,2*Math.sqrt(t)+1];for(;n-e>5e-4;){let r=(e+n)/2,[s,i]=[1,0];for(let o=1;o<=Hc(r);++o){let a=2*Math.exp(-o*o/(2*r*r));s+=a,i+=a*o*o}i<t*s?e=r:n=r}return Math.round(500*(e+n))/1e3}function Vc(t,e,n){let r=new Float32Array(4*n*128),s=Math.log(e.highestFrequency/.5)/35,i=Array.from({length:36},(l,u)=>.5*Math.exp(u*s)),o=i.map(l=>_d(t,l)),a=[0,...e.deviations].map(l=>i.map(u=>Math.exp(-2*(Math.PI*u*l)**2)));for(let l=0;l<128;++l){let u=l/127,d=t.scale*u/Math.max(1-u,1e-6);for(let h=0;h<3;++h){let[p,b]=[t.absorption[h],t.scattering[h]],_=t.field[0]+t.field[1]*Math.sqrt(p*d),[w,S]=[Math.exp(-(p+b)*d),Math.exp(-d*p-_*b*d)];if(!(S-w>1e-9))continue;let T=o.map(A=>{let M=(A/t.forward)**12;return Math.exp(d*(b*(A-(_-(1-t.forward))*M)-(p+b)))});wd(a,T,w,S).forEach((A,M)=>r[4*(128*M+l)+h]=A)}}return r}function _d({transform:t},e){let{values:n,min_frequency:r,max_frequency:s}=t,i=Math.log(e/r)/Math.log(s/r)*(n.length-1),o=Math.min(Math.max(Math.floor(i),0),n.length-2);return n[o]+(i-o)*(n[o+1]-n[o])}function wd(t,e,n,r){let s=t.map(p=>[...p.map((b,_)=>b/e[_]),1e3/r]),i=[...e.map(p=>(p-n)/p),1e3*(r-n)/r],o=(p,b)=>p.reduce((_,w,S)=>_+w*b[S],0),a=s.map(p=>o(p,i)),l=s.map((p,b)=>s.map((_,w)=>o(p,_)*(b===w?1+1e-9:1))),u=t.map(()=>0),d=t.map((p,b)=>b);for(;d.length;){let p=xd(d.map(_=>[...d.map(w=>l[_][w]),a[_]])),b=Math.min(...p);if(b>=0){d.forEach((_,w)=>u[_]=p[w]);break}d=d.filter((_,w)=>w!==p.indexOf(b))}let h=u.reduce((p,b)=>p+b,0);return h>0?u.map(p=>p*(r-n)/h):u}function xd(t){let e=t.length;for(let r=0;r<e;++r){let s=r;for(let i=r+1;i<e;++i)Math.abs(t[i][r])>Math.abs(t[s][r])&&(s=i);[t[r],t[s]]=[t[s],t[r]];for(let i=r+1;i<e;++i){let o=t[i][r]/t[r][r];for(let a=r;a<=e;++a)t[i][a]-=o*t[r][a]}}let n=new Array(e).fill(0);for(let r=e-1;r>=0;--r){let s=t[r][e];for(let i=r+1;i<e;++i)s-=t[r][i]*n[i];n[r]=s/t[r][r]}return n}var Qr=[41,31],Ed=Math.sqrt(1-1/1.34**2),Md=.05,Sd=.1,Bc=.84,Gc=60,Wc=1e9;function jc(t,e,n,r,s){let[i,o]=Qr,a=new Float32Array(4*i*o),{fx:l,fy:u,cx:d,cy:h,skew:p,width:b,height:_}=n,{sky:w}=t,S=Ad(t,Math.max(r,0),s),T=x=>w&&r<0&&x[2]>=0?w.map(A=>s*A):S(x);for(let x=0;x<o;++x)for(let A=0;A<i;++A){let M=-(_*x/(o-1)-.5-h)/u,z=(b*A/(i-1)-.5-d-p*M)/l;a.set(T(Fn(e,_t([z,M,-1]))),4*(i*x+A))}return a}function Ad(t,e,n){let{sun:r,open_water:s}=t,i=t.total.map((a,l)=>a*Math.exp(-t.loss[l]*e)),o=t.beam.map((a,l)=>Math.min(a*Math.exp(-t.beam_loss[l]*e),i[l]));return a=>{let l=a[2],u=l>0?Math.min(e/Math.max(l,1e-6),Wc):Wc,d=me(a,r),h=Rd(s.asymmetry,d),p=3*(1+Bc*d*d)/(4*Math.PI*(3+Bc)),b=.5+(.5-s.backscatter)*l/Math.sqrt(l*l+Sd);return[0,1,2].map(_=>{let w=s.attenuation[_],S=s.scattering[_],T=s.molecules[_],x=o[_]*(Math.PI/r[2])*(S*h+T*p)*zc(w*(1-l/r[2]),u),A=t.reflectance[_]*i[_],M=i[_]-o[_],z=(S*(b*M+(1-b)*A)+.5*T*(M+A))*zc(w-t.loss[_]*l,u),k=l>0?Td(t,_,l)*Math.exp(-Math.min(w*u,700)):0;return n*(x+z+k)})}}function Td(t,e,n){let r=Math.min(Math.max((n-Ed)/(2*Md)+.5,0),1),s=r*r*(3-2*r);return s*t.open_water.window+(1-s)*t.reflectance[e]*t.total[e]}function Rd(t,e){let n=t,r=Math.sqrt(1+n*n-2*n*Math.min(Math.max(e,-1),1));return(1-n*n)/(4*Math.PI*r**3)}function zc(t,e){let n=Math.min(Math.max(t*e,-Gc),Gc);return Math.abs(n)<1e-4?e*(1-n/2):(1-Math.exp(-n))/t}var Ld=[2654435769,2135587861],[Pd,kd]=[[3210233709,484763065],[2496678331,321982955]],Id=[[3605593784,1717173651],[2692095332,2025677871],[3875765969,2696161499]];function Yc(t){return[parseInt(t.slice(2,10),16),parseInt(t.slice(10),16)]}function qc(t){let e=bs([t[0]^t[0]>>>30,t[1]^(t[1]>>>30|t[0]<<2)],Pd),n=bs([e[0]^e[0]>>>27,e[1]^(e[1]>>>27|e[0]<<5)],kd);return[(n[0]^n[0]>>>31)>>>0,(n[1]^(n[1]>>>31|n[0]<<1))>>>0]}function ys(t,...e){return e.reduce((n,r,s)=>qc(Xc(n,bs(Fd(r),Id[s]))),t)}function Et(t,e){let[n,r]=qc(Xc(t,bs([0,e+1],Ld)));return(n*2**21+(r>>>11))*2**-53}function Fd(t){return[Math.floor(t/2**32)>>>0,t>>>0]}function Xc(t,e){let n=(t[1]>>>0)+(e[1]>>>0);return[t[0]+e[0]+ +(n>=2**32)>>>0,n>>>0]}function bs(t,e){let[n,r,s,i]=[t[1]&65535,t[1]>>>16,e[1]&65535,e[1]>>>16],o=r*s+(n*s>>>16),a=n*i+(o&65535);return[r*i+Math.floor(o/65536)+Math.floor(a/65536)+Math.imul(t[0],e[1])+Math.imul(t[1],e[0])>>>0,Math.imul(t[1],e[1])>>>0]}var _s=10,Qc=2e4,Cd=4e6,[Od,Nd,Dd]=[.02,4,3],[Jc,Ud,Hd,Vd,Bd]=[64,.25,2,.02,.08],$c=.5,Gd=0,[Wd,zd,jd,Yd]=[.02,9,.1,4];function ws(t,e,n,r,s){let i=t.classes.map(o=>{let a=new Ji(o,t,e,n,r);return o.concentration>0&&(o.is_plume?$d(a,t.source,s):qd(a,s)),a.records});return Float32Array.from(i.flat())}var Ji=class{constructor(e,n,r,s,i){this.sizeClass=e;this.drift=r;this.m=s;this.key=Yc(e.key),this.focal=Math.sqrt(i.fx*i.fy);let o=e.is_plume?n.range*Yd:n.range;this.reach=Math.min(o,e.max_diameter*this.focal/$c,i.far);let[a,l]=[(i.cy+.5)/i.fy,(i.cy+.5-i.height)/i.fy],u=Math.abs(i.skew)/i.fx*Math.max(Math.abs(a),Math.abs(l)),[d,h]=[-(i.cx+.5)/i.fx-u,(i.width-.5-i.cx)/i.fx+u];this.slopes=[d,h,l,a];let{velocity:p}=r;this.motion=this.toCamera(p[0],p[1],p[2]+e.rise_speed).map(b=>b*n.exposure_time)}sizeClass;drift;m;records=[];key;slopes;focal;reach;motion;toCamera(e,n,r){let{m:s}=this;return[s[0]*e+s[4]*n+s[8]*r,s[1]*e+s[5]*n+s[9]*r,s[2]*e+s[6]*n+s[10]*r]}mayContain([e,n,r],s){let{slopes:i}=this;if(r>s||e*e+n*n+r*r>(this.reach+s)**2)return!1;let o=i.map(a=>s*Math.hypot(1,a));return i[0]*-r-e<=o[0]&&e-i[1]*-r<=o[1]&&i[2]*-r-n<=o[2]&&n-i[3]*-r<=o[3]}diameterOf(e){let{min_diameter:n,max_diameter:r,slope:s}=this.sizeClass,i=(r/n)**(1-s);return n*(1+e*(i-1))**(1/(1-s))}add([e,n,r],s,i,o){let{slopes:a,sizeClass:l,motion:u}=this;if(-r<Bd)return;let d=s-.02*r+.5*(Math.abs(u[0])+Math.abs(u[1])+Math.abs(u[2]));if(e<a[0]*-r-d||e>a[1]*-r+d||n<a[2]*-r-d||n>a[3]*-r+d)return;let h=Math.hypot(e,n,r)/Math.min(this.reach,s*this.focal/$c);if(h>=1||this.records.length>=_s*Qc)return;let p=Math.min((1-h)/Ud,1),[b,_]=[u,1];if(l.kind===Gd){_=-Math.log(Math.max(Et(o,0),Vd));let w=s*Hd*Et(o,1);b=u.map((S,T)=>S+w*(2*Et(o,T+2)-1))}this.records.push(e,n,r,s/2,...b,i*p,l.reflectance*_,l.kind)}};function qd(t,e){let{m:n,sizeClass:r,drift:s,key:i}=t,{concentration:o,depth_scale:a}=r,l=Math.min(Math.max(Math.cbrt(Dd/o),Od),Nd),u=Math.min(o*l**3,Jc/2),d=[0,0,r.rise_speed*s.time],h=[n[3],n[7],n[11]].map((S,T)=>S-(s.displacement[T]+d[T])),[p,b]=Kc(t,h,l);for(;p.reduce((S,T,x)=>S*(b[x]-T+1),1)>Cd;)t.reach*=.7,[p,b]=Kc(t,h,l);let _=.8660254037844387*l+r.max_diameter,w=e-n[11];for(let S=p[0];S<=b[0];++S)for(let T=p[1];T<=b[1];++T)for(let x=p[2];x<=b[2];++x){let A=t.toCamera((S+.5)*l-h[0],(T+.5)*l-h[1],(x+.5)*l-h[2]);if(!t.mayContain(A,_))continue;let M=ys(i,S,T,x),z=Xd(Et(M,0),u);for(let k=0;k<z;++k){let U=1+5*k,[V,X,Y]=[S,T,x].map((H,J)=>(H+Et(M,U+J))*l-h[J]),P=w-Y;if(P<0)continue;let K=a===null?1:Math.exp(-P/a)-Et(M,U+4);if(K<=0)continue;let D=a===null?1:Math.min(K/.05,1),q=t.diameterOf(Et(M,U+3));t.add(t.toCamera(V,X,Y),q,D,ys(M,k,0,0))}}}function Kc({slopes:t,reach:e,m:n},r,s){let i=Math.hypot(Math.max(...t.slice(0,2).map(Math.abs)),Math.max(...t.slice(2).map(Math.abs))),o=Math.atan(i),a=[0,1,2].map(l=>{let u=Math.acos(Math.min(Math.max(-n[4*l+2],-1),1)),d=u<=o?1:Math.cos(u-o),h=Math.PI-u<=o?-1:Math.cos(Math.min(u+o,Math.PI));return[e*Math.min(h,0),e*Math.max(d,0)]});return[0,1].map(l=>a.map((u,d)=>Math.floor((r[d]+u[l])/s)))}function Xd(t,e){let[n,r]=[0,Math.exp(-e)],s=r;for(;t>s&&n<Jc;)n+=1,r*=e/n,s+=r;return n}function $d(t,e,n){let{m:r,sizeClass:s,drift:i,key:o}=t,[a,l,u]=[s.concentration,s.rise_speed,n-e[2]];if(u<=0)return;let d=Math.floor(a*i.time),h=Math.max(Math.ceil(a*(i.time-u/l)),0,d-Qc+1);for(let p=h;p<=d;++p){let b=ys(o,p),_=i.time-p/a,w=l*_,S=2*Math.PI*Et(b,0),T=jd*w*Math.sqrt(Et(b,1)),x=2*Math.PI*Et(b,2)+zd*_,A=Wd*Math.min(10*w,1),M=[T*Math.cos(S)+A*Math.cos(x),T*Math.sin(S)+A*Math.sin(x),w],[z,k,U]=M.map((V,X)=>e[X]+i.velocity[X]*_+V-r[4*X+3]);t.add(t.toCamera(z,k,U),t.diameterOf(Et(b,3)),1,b)}}var Kd=1.5,Zi=8,Qd=[4,4,2],xs=class{constructor(e,n){this.gl=e;this.programs=n;this.records=e.createBuffer(),this.lens=e.createBuffer(),this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,this.records);let r=0;Qd.forEach((s,i)=>{e.enableVertexAttribArray(Zi+i),e.vertexAttribPointer(Zi+i,s,e.FLOAT,!1,4*_s,r),e.vertexAttribDivisor(Zi+i,1),r+=4*s}),e.bindVertexArray(null)}gl;programs;records;lens;vertexArray;draw({spec:e,records:n},r,s){let{gl:i}=this;if(i.clearColor(0,0,0,0),i.clear(i.COLOR_BUFFER_BIT),!n.length)return;i.bindBuffer(i.UNIFORM_BUFFER,this.lens);let o=Float32Array.of(e.aperture/2,1/e.focus_distance,Kd,0);i.bufferData(i.UNIFORM_BUFFER,o,i.STREAM_DRAW),i.bindBufferBase(i.UNIFORM_BUFFER,yr.ParticleLens,this.lens),i.useProgram(this.programs.get("particle",r?{LAMPS:r,...s}:s)),i.enable(i.BLEND),i.blendFunc(i.ONE,i.ONE),i.bindVertexArray(this.vertexArray),i.bindBuffer(i.ARRAY_BUFFER,this.records),i.bufferData(i.ARRAY_BUFFER,n,i.STREAM_DRAW),i.drawArraysInstanced(i.TRIANGLE_STRIP,0,4,n.length/_s),i.bindVertexArray(null),i.disable(i.BLEND)}};var Jd=16,Zd="6e4",Es=class t{constructor(e,n,r,s){this.gl=e;this.programs=n;this.nodes=r;this.format=s?e.RGBA16F:e.RGBA32F,this.switches=s?{FAR:Zd}:{},this.particlePass=new xs(e,n),this.map=this.texture(Qr[0],Qr[1],this.format)}gl;programs;nodes;switches;format;particlePass;map;tables=[];table=null;targets=new Map;static make(e,n,r){return["EXT_color_buffer_float","OES_texture_float_linear","EXT_float_blend"].every(i=>e.getExtension(i))?new t(e,n,r,!1):!e.getExtension("EXT_color_buffer_float")&&!e.getExtension("EXT_color_buffer_half_float")?null:new t(e,n,r,!0)}plan(e,n){return Dc(e,this.nodes,n)}prepare(e,n,r,s,i,o){return this.table=s.deviations.length?this.tableOf(e,s):null,this.upload(this.map,Qr[0],Qr[1],jc(e,n,r,i,o)),this.targetsOf(r,s).surfaces.buffer}develop(e,n,r,s,i,o){let a=this.targetsOf(n,r),l=e.lamp_veil?s:0;this.bind(he.open_water_map,this.map),this.table&&this.bind(he.weight_table,this.table);let u=this.table?{BLUR:1}:{};if((r.spreads.length||l)&&(this.drawScattered(a,r,l),this.bind(he.level_0,a.levels[0].total.textures[0]),u.SCATTERED=1),this.bind(he.surface_image,a.surfaces.textures[0]),o){let d=a.particles??=this.target(n.width,n.height,1,this.format);this.begin(d),this.particlePass.draw(o,s,this.switches),this.bind(he.particle_image,d.textures[0]),u.PARTICLES=1}return e.linear&&(u.LINEAR=1),i&&(u.GREY=1),this.draw("developed",u,a.colours),a.colours.textures[0]}present(e,n,r,{width:s,height:i},o){let{gl:a}=this;this.bind(he.level_0,e),a.bindFramebuffer(a.FRAMEBUFFER,n),a.viewport(r[0],r[1],s,i),a.useProgram(this.programs.get("presented",o?{}:{FLIPPED:1},"presented")),a.drawArrays(a.TRIANGLES,0,3)}drawScattered({surfaces:e,sources:n,levels:r},s,i){let o=s.spreads.length;this.bind(he.surface_image,e.textures[0]),this.draw("scattered",{N_LEVELS:Math.min(o,1)},n[0]),o>1&&(this.bind(he.surface_image,n[0].textures[1]),this.draw("scattered",{WIDE:1,N_LEVELS:o-1},n[1]));for(let a=2;a<n.length;++a)n[a-1].textures.slice(1).forEach((l,u)=>this.bind(he.level_0+u,l)),this.draw("reduced",{N_LEVELS:n[a].textures.length},n[a]);for(let a=r.length-1;a>=0;--a){let l=s.spreads[a]??0,u=Uc(l);this.bind(he.level_0,n[a].textures[0]),l>0&&(this.draw("blurred_rows",{...u},r[a].rows),this.bind(he.level_0,r[a].rows.textures[0])),a+1<r.length&&(this.bind(he.level_1,r[a+1].total.textures[0]),u.WIDER=1),a===0&&i&&(this.bind(he.level_2,n[0].textures.at(-1)),u.LAMPS=i),o||(u.VEIL_ONLY=1),this.draw("blurred",u,r[a].total)}}begin(e){this.gl.bindFramebuffer(this.gl.FRAMEBUFFER,e.buffer),this.gl.viewport(0,0,e.width,e.height)}draw(e,n,r){let{gl:s}=this;this.begin(r),s.useProgram(this.programs.get(e,{...this.switches,...n},"screen")),s.drawArrays(s.TRIANGLES,0,3)}bind(e,n){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,n),this.gl.activeTexture(this.gl.TEXTURE0)}tableOf(e,n){let r=n.deviations.join(),s=this.tables.find(o=>o.key===r&&o.optics===e.transform);if(s)return s.texture;this.tables.length>=Jd&&this.gl.deleteTexture(this.tables.shift().texture);let i=this.texture(128,9,this.format);return this.upload(i,128,9,Vc(e,n,9)),this.tables.push({optics:e.transform,key:r,texture:i}),i}targetsOf({width:e,height:n},r){let{gl:s,format:i}=this,o=r.deviations.length,a=`${e} ${n} ${o}`,l=this.targets.get(a);if(l)return l;this.targets.size>7&&this.deleteTargets();let u=s.createRenderbuffer();s.bindRenderbuffer(s.RENDERBUFFER,u),s.renderbufferStorage(s.RENDERBUFFER,s.DEPTH_COMPONENT24,e,n);let d=this.target(e,n,1,i);s.framebufferRenderbuffer(s.FRAMEBUFFER,s.DEPTH_ATTACHMENT,s.RENDERBUFFER,u),d.depth=u,l={surfaces:d,colours:this.target(e,n,1,s.RGBA8),particles:null,sources:[],levels:[]};let[h,p]=[e,n];for(let b=0;b<Math.max(o,1);++b){[h,p]=[Math.ceil(h/2),Math.ceil(p/2)];let _=b===0?Math.min(o,1)+1:o-b;l.sources.push(this.target(h,p,_,i)),l.levels.push({rows:this.target(h,p,1,i),total:this.target(h,p,1,i)})}return this.targets.set(a,l),l}target(e,n,r,s){let{gl:i}=this,o=Array.from({length:r},()=>this.texture(e,n,s)),a=i.createFramebuffer();return i.bindFramebuffer(i.FRAMEBUFFER,a),o.forEach((l,u)=>i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+u,i.TEXTURE_2D,l,0)),i.drawBuffers(o.map((l,u)=>i.COLOR_ATTACHMENT0+u)),{buffer:a,textures:o,width:e,height:n}}texture(e,n,r){let{gl:s}=this,i=s.createTexture();s.bindTexture(s.TEXTURE_2D,i),s.texStorage2D(s.TEXTURE_2D,1,r,e,n);for(let o of[s.TEXTURE_MIN_FILTER,s.TEXTURE_MAG_FILTER])s.texParameteri(s.TEXTURE_2D,o,s.LINEAR);for(let o of[s.TEXTURE_WRAP_S,s.TEXTURE_WRAP_T])s.texParameteri(s.TEXTURE_2D,o,s.CLAMP_TO_EDGE);return i}upload(e,n,r,s){let{gl:i}=this;i.bindTexture(i.TEXTURE_2D,e),i.texSubImage2D(i.TEXTURE_2D,0,0,0,n,r,i.RGBA,i.FLOAT,s)}deleteTargets(){let{gl:e}=this;for(let{surfaces:n,colours:r,particles:s,sources:i,levels:o}of this.targets.values())for(let a of[n,r,...s?[s]:[],...i,...o.flatMap(({rows:l,total:u})=>[l,u])]){for(let l of a.textures)e.deleteTexture(l);e.deleteFramebuffer(a.buffer),a.depth&&e.deleteRenderbuffer(a.depth)}this.targets.clear()}};function eu({worldFromCamera:t,intrinsics:e,water:n,optics:r},s,i,o,a){let{near:l,far:u}=e,{ambient:d,specular:h,suns:p}=s,b=n.light_rate,_=r?.absorption.map((A,M)=>A+r.scattering[M])??n.attenuation,w=n.follows_light===!1?1:b,[S,T]=[n.colour,n.fog_colour].map(A=>A.map(M=>w*M)),x=n.fog>0?T:S;return Float32Array.from([...zt(i),...zt(Ie(a.textureFromWorld,t)),t[8],t[9],t[10],Re(t)[2]-n.surface_height,...Cn(t,o),a.lift,...p[n.sun].colour.map(A=>b*A),0,b*d,b*h,0,0,...S,0,..._,0,...T,n.fog**2,(u+l)/(u-l),-2*u*l/(u-l),0,0,...x,0])}var to=256,Ms=class{constructor(e,n){this.gl=e;this.models=n;this.values=new Float32Array(to/4*Math.max(1,n.instances.length)),this.buffer=e.createBuffer()}gl;models;values;buffer;fill(e,n){this.models.instances.forEach((r,s)=>{let i=to/4*s;this.values.set(zt(Ie(e,r.worldFromMesh)),i),n&&this.values.set(zt(Ie(n,r.normals)),i+16)}),this.gl.bindBuffer(this.gl.UNIFORM_BUFFER,this.buffer),this.gl.bufferData(this.gl.UNIFORM_BUFFER,this.values,this.gl.STREAM_DRAW)}drawPiece({instance:e,firstIndex:n,count:r},s){let i=this.gl;e.visual.two_sided?i.disable(i.CULL_FACE):i.enable(i.CULL_FACE),i.frontFace(e.isMirrored!==s?i.CW:i.CCW),i.bindBufferRange(i.UNIFORM_BUFFER,yr.Instance,this.buffer,to*e.index,160),i.bindVertexArray(e.vertexArray);let[o,a]=e.hasUint32Indices?[i.UNSIGNED_INT,4]:[i.UNSIGNED_SHORT,2];i.drawElements(i.TRIANGLES,r,o,a*n)}};var ep=5,tp=320*240,tu=4;function wn(t){let e=t.getExtension("WEBGL_debug_renderer_info"),n=e?String(t.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return/swiftshader|llvmpipe|software|softpipe/i.test(n)}var Ss=class{constructor(e,n,r){this.gl=e;this.head=n;this.models=r;this.isSoftware=wn(e),this.programs=new fs(e),this.instanceBlocks=new Ms(e,r),this.shadows=new vs(e,this.programs,this.instanceBlocks);let{nodes:s}=n.water;this.development=s?Es.make(e,this.programs,s):null,this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(i=>{let o=e.createSampler();return e.samplerParameteri(o,e.TEXTURE_MIN_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_WRAP_S,i),e.samplerParameteri(o,e.TEXTURE_WRAP_T,i),o})}gl;head;models;isSoftware;programs;instanceBlocks;shadows;blocks={};samplers;development;get lacksFloats(){return!!this.head.water.nodes&&!this.development}draw(e,n,r,s=!1){e.optics&&this.development?this.drawPhysical(e,e.optics,n,r,s):this.drawSurfaces(e,n,r,s,{})}drawPhysical(e,n,r,s,i){let o=this.development,{worldFromCamera:a,water:l}=e,u=this.isSoftware&&!e.isExact,d=this.isSoftware||e.isExact||devicePixelRatio>=2?1:2,h=an(e.intrinsics,d),p=h.width*h.height>tp,b=o.plan(h,n.blur&&!(u&&p)),_=e.lamps.slice(0,tu),w=l.surface_height-Re(a)[2],S=o.prepare(n,a,h,b,w,l.light_rate);this.fill("Optics",Nc(n,h,_,l.light_rate,b.reach)),this.drawSurfaces({...e,intrinsics:h,grey:!1},S,[0,0],!0,{PHYSICAL:1,...o.switches}),_.length&&this.drawLampPoints(_.length,o.switches),this.gl.disable(this.gl.DEPTH_TEST);let T=this.findParticles(e,h),x=o.develop(n,h,b,_.length,e.grey===!0,T);o.present(x,r,s,e.intrinsics,i)}findParticles({drift:e,worldFromCamera:n,water:r},s){let i=this.head.particles;return!i||!e?null:{spec:i,records:ws(i,e,n,s,r.surface_height)}}drawLampPoints(e,n){let{gl:r}=this;r.useProgram(this.programs.get("lamp_point",{COLOUR:0,LAMPS:e,...n})),r.depthMask(!1),r.enable(r.BLEND),r.blendFuncSeparate(r.ONE,r.ONE,r.ONE,r.ZERO),r.drawArrays(r.POINTS,0,e),r.disable(r.BLEND),r.depthMask(!0)}drawSurfaces(e,n,r,s,i){let{gl:o,models:a}=this,{worldFromCamera:l,intrinsics:u,water:d}=e,h=Hr(u,s),p={worldFromCamera:l,clip:h,intrinsics:u},b=a.instances.filter(A=>e.isExternal||!A.visual.hidden).flatMap(A=>A.pieces),_=ps(b,p),w={COLOUR:0,...i},S=d.fog>0;!i.PHYSICAL&&!S&&(w.NO_FOG=1),!i.PHYSICAL&&S&&d.clip&&!e.isExternal&&(w.FOG_CLIP=1),e.grey&&(w.GREY=1),e.isExternal&&Object.assign(w,{AIR:1,POLISHED:1}),e.isExternal&&!this.isSoftware&&(w.SOFT=1);let T=i.PHYSICAL?e.optics.sun:_t(this.head.suns[d.sun].direction);d.shadows&&this.updateSunShadows(b,_,T,p)&&(w.SHADOWS=1),this.lightScene(e,b,w),this.fill("Frame",eu(e,this.head,h,T,this.shadows)),this.instanceBlocks.fill(ut(l),rp(l)),o.bindFramebuffer(o.FRAMEBUFFER,n),o.viewport(r[0],r[1],u.width,u.height),o.enable(o.SCISSOR_TEST),o.scissor(r[0],r[1],u.width,u.height),o.depthMask(!0),o.clear(o.DEPTH_BUFFER_BIT),o.enable(o.DEPTH_TEST),o.depthFunc(o.LEQUAL),o.disable(o.BLEND);for(let A of _.filter(_n))this.drawPiece(A,p,w,s);this.drawBackground(e.grey?{COLOUR:0,GREY:1,...i}:{COLOUR:0,...i}),o.enable(o.BLEND),o.blendFuncSeparate(o.SRC_ALPHA,o.ONE_MINUS_SRC_ALPHA,o.ZERO,o.ONE),o.depthMask(!1);for(let A of _.filter(M=>!_n(M)).reverse()){let M=Math.round(255*A.instance.visual.opacity);M>0&&this.drawPiece(A,p,{...w,OPACITY:M},s)}this.models.maps?.release(),o.depthMask(!0),o.disable(o.BLEND),o.disable(o.SCISSOR_TEST),o.bindVertexArray(null)}updateSunShadows(e,n,r,s){let i=e.filter(a=>_n(a)&&this.models.radius(a.instance)<=ep),o=Ac(i,n,r,s);return o.length&&this.shadows.updateSunShadows(o,r,this.models.version),this.bind(he.shadow_map,this.shadows.sunMap.texture),o.length>0}lightScene(e,n,r){let s=e.lamps.slice(0,tu);s.length&&(r.LAMPS=s.length,this.shadows.updateLampShadows(s,n,this.models.version),this.bind(he.lamp_maps,this.shadows.lampMaps.texture),this.fill("Lamps",Cc(s,e.worldFromCamera)));let{projector:i}=this.head;if(!i)return;r.PROJECTOR=1;let{width:o,height:a}=this.head.textures[i.pattern],l=this.models.worldFromMount(i),u=Fc(i,o,a);this.shadows.updateProjectorShadows(l,u,n),this.bind(he.projector_map,this.shadows.projectorMap.texture),this.bind(he.projector_pattern,this.models.patterns[0]),this.fill("Projector",Oc(i,l,u,e.worldFromCamera))}drawPiece(e,n,r,s){let[{gl:i},{texture:o,repeats:a,visual:l}]=[this,e.instance],u=Lc(e,n)?this.samplers:null;o&&(this.bind(he.base_map,o),i.bindSampler(he.base_map,u&&u[Number(a)]));let d=this.models.maps.use(l.material,o?{...r,TEXTURED:1}:r,u);i.useProgram(this.programs.get("surface",d)),this.instanceBlocks.drawPiece(e,s)}drawBackground(e){let{gl:n}=this;n.bindSampler(he.base_map,null),n.disable(n.CULL_FACE),n.bindVertexArray(null),n.useProgram(this.programs.get("background",e)),n.drawArrays(n.TRIANGLES,0,3)}fill(e,n){let{gl:r}=this;this.blocks[e]??=r.createBuffer(),r.bindBuffer(r.UNIFORM_BUFFER,this.blocks[e]),r.bufferData(r.UNIFORM_BUFFER,n,r.STREAM_DRAW),r.bindBufferBase(r.UNIFORM_BUFFER,yr[e],this.blocks[e])}bind(e,n){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,n),this.gl.activeTexture(this.gl.TEXTURE0)}};function rp(t){let e=t;return Le([e[0],e[4],e[8],0,e[1],e[5],e[9],0,e[2],e[6],e[10],0,0,0,0,1])}var np=150,sp=2e3,ip=300,op=100;function ru(t){let e=document.createElement("canvas").getContext("webgl2");if(!e)return null;let n=!wn(e);return e.getExtension("WEBGL_lose_context")?.loseContext(),t.getContext("webgl2",{alpha:!1,antialias:n,powerPreference:"high-performance"})}var ro=class{constructor(e){this.gl=e}gl;fence=null;beginTime=0;pauseEnd=0;responsiveEnd=0;begin(){this.fence&&this.gl.deleteSync(this.fence),this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.beginTime=performance.now()}skipPauses(){this.responsiveEnd=performance.now()+ip}isReady(e){let{gl:n,fence:r}=this,s=n.isContextLost()||e-this.beginTime>sp;return r&&(s||n.getSyncParameter(r,n.SYNC_STATUS)===n.SIGNALED)&&(n.deleteSync(r),this.fence=null,this.pauseEnd=Math.min(2*e-this.beginTime,e+op)),!this.fence&&(e>=this.pauseEnd||e<this.responsiveEnd)}},As=class t{constructor(e,n,r){this.gl=e;this.models=r;let s=this.head=n.head;this.media=new ss(n),this.renderer=e&&new Ss(e,s,r),this.pacing=e&&wn(e)?new ro(e):null;for(let i of s.cameras){let o=j("figure");o.append(j("figcaption",`${i.name} · redrawn, no noise`)),o.style.aspectRatio=`${i.width} / ${i.height}`,N("pictures").append(o),this.frames.push(o)}}gl;models;canvas=N("image");head;overlay=N("overlay");renderer;frames=[];images=[];pacing;media;static async make(e,n){return new t(e,n,await ds.load(e,n))}draw(e,n,r,s){let{canvas:i,head:o,models:a}=this,l=this.gl&&wn(this.gl)?1:Math.min(devicePixelRatio,2),[u,d]=[i.clientWidth,i.clientHeight];if(u===0||d===0)return null;for(let U of[i,this.overlay]){let[V,X]=[Math.round(u*l),Math.round(d*l)];(U.width!==V||U.height!==X)&&([U.width,U.height]=[V,X])}a.place(n.poses),o.sand?.forEach((U,V)=>a.setSand(V,e.sand(V,n.time)));let h=r.viewCamera(u,d),p=this.water(e,n,s),b=this.media.mediumAt(n),_=this.lamps(n),{worldFromCamera:w,isExternal:S}=h,T=an(h.intrinsics,l),x=h.camera?.grey,A=n.drift(),M={worldFromCamera:w,intrinsics:T,water:p,optics:b,lamps:_,isExternal:S,grey:x,drift:A},z={...M,water:{...p,fog:0},optics:this.media.clearOptics(b),drift:null};this.renderer?.draw(s.clear?z:M,null,[0,0]);let k=this.overlay.getContext("2d");if(k.setTransform(l,0,0,l,0,0),k.clearRect(0,0,u,d),Mc(k,w,h.intrinsics,o,a,e,n,s),h.camera&&Xi(k,h.camera,h.intrinsics,0,0,n),r.mode==="map"){let U=N("hud");Sc(k,h.intrinsics,r.height,U.offsetTop+U.offsetHeight)}return this.frames.forEach((U,V)=>U.hidden=o.cameras[V]===h.camera),this.drawPictures(k,{...M,isExternal:!1},n,s,l,d),this.pacing?.begin(),h}get lacksFloats(){return this.renderer?.lacksFloats??!1}skipPauses(){this.pacing?.skipPauses()}isReady(){return this.pacing?.isReady(performance.now())??!0}image(e,n,r,s,i,o={}){let{gl:a,models:l,renderer:u}=this;if(!a||!u)return new Uint8Array;l.place(s.poses);let d=a.createFramebuffer();a.bindFramebuffer(a.FRAMEBUFFER,d);let h=[a.createRenderbuffer(),a.createRenderbuffer()];[a.RGBA8,a.DEPTH_COMPONENT24].forEach((x,A)=>{a.bindRenderbuffer(a.RENDERBUFFER,h[A]),a.renderbufferStorage(a.RENDERBUFFER,x,e.width,e.height);let M=A?a.DEPTH_ATTACHMENT:a.COLOR_ATTACHMENT0;a.framebufferRenderbuffer(a.FRAMEBUFFER,M,a.RENDERBUFFER,h[A])});let{isExternal:p=!1,isClear:b,grey:_}=o,w=this.media.mediumAt(s),S={worldFromCamera:n,intrinsics:e,lamps:this.lamps(s),isExternal:p,isExact:!0,grey:_,drift:b?null:s.drift(),optics:b?this.media.clearOptics(w):w,water:{...this.water(r,s,i),...o.water,...b?{fog:0}:{}}};u.draw(S,d,[0,0],!0);let T=new Uint8Array(4*e.width*e.height);a.readPixels(0,0,e.width,e.height,a.RGBA,a.UNSIGNED_BYTE,T);for(let x of h)a.deleteRenderbuffer(x);return a.deleteFramebuffer(d),T}pictureWidth(){let e=this.head.cameras.map(({width:n,height:r})=>n/r);return Math.round(np*Math.max(...e)*Math.min(devicePixelRatio,2))}show(e,n){this.frames[e]&&(this.images[e]?this.images[e].close():this.frames[e].querySelector("figcaption").textContent=this.head.cameras[e].name,this.images[e]=n)}drawPictures(e,n,r,s,i,o){if(N("pictures").hidden=!s.pictures,!s.pictures)return;let a=this.canvas.getBoundingClientRect();this.head.cameras.forEach((l,u)=>{if(this.frames[u].hidden)return;let d=this.frames[u].getBoundingClientRect(),[h,p]=[d.left-a.left+1,d.top-a.top+1],b=ji(l,d.width-2,d.height-2);if(this.images[u])e.drawImage(this.images[u],h,p,d.width-2,d.height-2);else{let _=this.models.worldFromMount(l),w=[Math.round(h*i),Math.round((o-p-d.height+2)*i)],{grey:S}=l,T={...n,worldFromCamera:_,intrinsics:an(b,i),grey:S};this.renderer?.draw(T,null,w)}Xi(e,l,b,h,p,r)})}water(e,n,r){let s=e.levels[hr(e,n.time)]?.level.values??{},{fog:i,light_rate:o}=this.head.water;return{...this.head.water,fog:n.signal("fog")??s.fog??i,light_rate:n.signal("light_rate")??s.light??o,sun:r.sun||this.head.water.sun}}lamps(e){return this.head.lamps.map((n,r)=>({lamp:n,index:r,brightness:e.signal(`lamp/${n.name}`)??Number(n.on)})).filter(({brightness:n})=>n>0).map(({lamp:n,index:r,brightness:s})=>({index:r,lamp:{...n,intensity:s*n.intensity},worldFromLamp:this.models.worldFromMount(n)}))}};var xn=class{constructor(e,n,r,s={}){this.time=e;for(let[o,a]of Object.entries(s))this.poses.set(o,st(a));if(!n||!r)return;n.bodies.forEach((o,a)=>this.poses.set(o,st(r,7*a)));let i=7*n.bodies.length;n.signals.forEach((o,a)=>this.signals.set(o.name,r[i+a]))}time;poses=new Map;signals=new Map;signal(e){let n=this.signals.get(e);return n===void 0||Number.isNaN(n)?void 0:n}drift(){let e=n=>[..."xyz"].map(r=>this.signal(`${n}/${r}`)??0);return{displacement:e("particles"),velocity:e("particle_velocity"),time:this.time}}points(e,n){let r=[];for(let s=0;;++s){if(!this.signals.has(`${e}/${s}/${n[0]}`))return r;let i=n.map(o=>this.signal(`${e}/${s}/${o}`));i.every(o=>o!==void 0)&&r.push(i)}}};var nu=6,Ts=.2,ap=30,lp=1e4,Rs=class{constructor(e){this.pack=e;let n=e.head.trials??[];this.levels=n.flatMap(({levels:r},s)=>r.map(i=>({trial:s,level:i})))}pack;isLive=!1;levels;curves=[];trial=-1;version=0;title="";motion=null;trailStart=-1/0;get start(){let e=this.levels.filter(({trial:n})=>n===this.trial);return Math.min(this.motion?.head.start??1/0,e[0]?.level.start??0)}get end(){let e=this.levels.filter(({trial:n})=>n===this.trial);return Math.max(this.motion?.end??0,...e.map(({level:n})=>n.end))}async select(e){if(e===this.trial)return;let n=this.pack.head.trials?.[e];this.trial=e,this.motion=null,this.trailStart=-1/0,this.curves=[],n&&(this.title=n.title,this.curves=n.curves.map(({name:r,unit:s,times:i,values:o,names:a,is_share:l})=>({name:r,unit:s,names:a,isFraction:l,times:Array.from(this.pack.numbers(i),u=>u/lp),values:Array.from(this.pack.numbers(o),u=>Number.isNaN(u)?null:u)})),n.motion&&(this.motion=await Vo(this.pack.numbers(n.motion))))}snapshot(e){let n=this.pack.head.trials?.[this.trial]?.poses;return new xn(e,this.motion?.head??null,this.motion?.row(e)??null,n)}speed(e,n){let r=this.motion,s=r?.head.bodies.indexOf(e)??-1;if(!r||s<0)return null;let i=r.head.start+(r.head.n-1)/r.head.rate,o=Math.min(i,Math.max(n,r.head.start+Ts)),a=[o-Ts,o].map(l=>[...r.row(l).slice(7*s,7*s+3)]);return su(a[0],a[1],Ts)}markers(e){let[n,r]=[this.motion,this.motion?.head.markers];if(!n||!r)return[];let s=n.rowIndex(e),i=new Map;for(let o of r.changes){if(o[0]>s)break;o.length>2?i.set(o[1],o):i.delete(o[1])}return[...i.values()].map(([,o,a,l,u])=>{let d=st(u),h=r.shapes[a].map(p=>p.map(b=>Pe(d,b)));return{name:o,at:u.slice(0,3),colour:l,lines:h}})}sand(e,n){let r=this.motion?.rowIndex(n)??-1;return this.motion?.removals.filter(s=>s.heap===e&&s.row<=r)??[]}trail(e,n){let r=this.motion,s=r?.head.bodies.indexOf(e)??-1;if(!r||s<0)return[];let{rate:i,start:o,n:a}=r.head,l=Math.min(a-1,Math.floor((n-o)*i)),u=[],d=Math.max(0,Math.ceil((this.trailStart-o)*i));for(let h=d;h<=l;h+=Math.max(1,Math.round(i/nu))){let p=h*r.columns+7*s;u.push(Array.from(r.rows.subarray(p,p+3)))}return u}clearTrails(e){this.trailStart=e}};function su(t,e,n){let r=Math.hypot(...e.map((s,i)=>s-t[i]))/n;return n>0&&r<ap?r:null}var Ls=class{constructor(e){this.head=e;this.title=e.title}head;isLive=!0;start=0;curves=[];levels=[];trial=0;end=0;title;version=0;currentMarkers=[];heights=new Map;row=null;recentRows=[];trails=[];push(e,n){let r=this.trails.at(-1);for(e===this.end&&(this.version+=1),e<this.end&&(this.trails.length=this.recentRows.length=0),(!r||e-r.time>=1/nu)&&this.trails.push({time:e,row:n}),this.trails.length>2e4&&this.trails.splice(0,1e4),this.recentRows.push({time:e,row:n});this.recentRows.length>2&&this.recentRows[1].time<=e-Ts;)this.recentRows.shift();this.row=n,this.end=e}speed(e){let n=this.head.motion?.bodies.indexOf(e)??-1,[r,s]=[this.recentRows[0],this.recentRows.at(-1)];if(n<0||!r||!s||s.time<=r.time)return null;let i=[r,s].map(({row:o})=>[0,1,2].map(a=>o[7*n+a]));return su(i[0],i[1],s.time-r.time)}sample(e,n,r,s){let i=this.curves.find(o=>o.name===e);i||(i={name:e,unit:n,times:[],values:[]},this.curves.push(i)),i.times.push(r),i.values.push(s)}setLevels(e){this.levels.splice(0,this.levels.length,...e.map(n=>({trial:0,level:n}))),this.version+=1}async select(){}snapshot(){return new xn(this.end,this.head.motion??null,this.row)}setMarkers(e){this.currentMarkers=e,this.version+=1}markers(){return this.currentMarkers}setSand(e,n){this.heights.set(e,n),this.version+=1}sand(e){return this.heights.get(e)??[]}trail(e){let n=this.head.motion?.bodies.indexOf(e)??-1;return n<0?[]:this.trails.map(({row:r})=>[0,1,2].map(s=>r[7*n+s]))}clearTrails(){this.trails.length=0}};var cp=.5,Ps=class{constructor(e){this.pack=e}pack;cast(e,n,r,s){let i=1;for(let o of this.pack.head.bodies){if(!o.visuals.length||s(o))continue;let a=r(o.name);for(let l of o.visuals){if(l.hidden||l.opacity<cp)continue;let u=fp(Ie(a,Le(l.matrix)));if(!u)continue;let[d,h]=[Pe(u,e),Pe(u,n)];i=Math.min(i,this.hitMesh(l,d,h,i))}}return i}hitMesh(e,n,r,s){let i=this.pack.head.meshes[e.mesh],o=Me(r,n,-1),a=me(o,o);for(let l of i.pieces){let u=Me([l[2],l[3],l[4]],n,-1),d=a>0?Math.min(s,Math.max(0,me(u,o)/a)):0,h=Me(u,o,-d);if(me(h,h)>l[5]*l[5])continue;let p=this.pack.numbers(i.positions),b=this.pack.numbers(i.triangles);for(let _=l[0];_<l[0]+l[1];_+=3)s=Math.min(s,up(p,b,_,n,o))}return s}};function up(t,e,n,r,s){let[i,o,a]=[3*e[n],3*e[n+1],3*e[n+2]],[l,u,d]=[t[i],t[i+1],t[i+2]],[h,p,b]=[t[o]-l,t[o+1]-u,t[o+2]-d],[_,w,S]=[t[a]-l,t[a+1]-u,t[a+2]-d],[T,x,A]=[s[0],s[1],s[2]],[M,z,k]=[x*S-A*w,A*_-T*S,T*w-x*_],U=h*M+p*z+b*k;if(Math.abs(U)<1e-14)return 1/0;let[V,X,Y]=[r[0]-l,r[1]-u,r[2]-d],P=(V*M+X*z+Y*k)/U;if(P<0||P>1)return 1/0;let[K,D,q]=[X*b-Y*p,Y*h-V*b,V*p-X*h],H=(T*K+x*D+A*q)/U;if(H<0||P+H>1)return 1/0;let J=(_*K+w*D+S*q)/U;return J>=0?J:1/0}function fp(t){let e=[0,1,2].map(o=>[t[4*o],t[4*o+1],t[4*o+2]]),n=[nt(e[1],e[2]),nt(e[2],e[0]),nt(e[0],e[1])],r=me(e[0],n[0]);if(Math.abs(r)<1e-18)return null;let s=[0,1,2].map(o=>n.map(a=>a[o]/r)),i=s.map(o=>-me(o,[t[3],t[7],t[11]]));return Le([...s.flatMap((o,a)=>[...o,i[a]]),0,0,0,1])}function ou(t){let{player:e,picture:n}=t;Object.assign(window,{uwsim:{page:t,seek:r=>t.seek(r),go:r=>t.go(r),time:()=>t.time,level:()=>hr(e,t.time),curves:()=>Object.fromEntries(e.curves.map(r=>[r.name,Di(r,t.time)])),body:r=>Array.from(n.models.body(r)),markers:()=>e.markers(t.time),sand:r=>Array.from(n.models.heights(r)),particles:r=>{let{cameras:s,particles:i,water:o}=t.pack.head,a=s.find(d=>d.name===r),l=e.snapshot(t.time);n.models.place(l.poses);let u=n.models.worldFromMount(a);return Array.from(ws(i,l.drift(),u,a,o.surface_height))},image:(r,s={})=>{let i=t.pack.head.cameras.find(u=>u.name===r),o=e.snapshot(t.time);n.models.place(o.poses);let a=n.models.worldFromMount(i),l={grey:i.grey,water:s};return iu(n.image(i,a,e,o,t.switches,l))},external:(r,s)=>{let[i]=t.pack.head.cameras,o={isExternal:!0,isClear:s},a=e.snapshot(t.time);return iu(n.image(i,Le(r),e,a,t.switches,o))}}})}function iu(t){let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}var hp="This browser does not support WebGL 2: the page shows no 3-D view, only the results (levels and curves).",mp="This browser cannot draw into floating-point textures: the page shows the fog of the scene, not its physical water.";async function dp(){let t=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.theme=t?"dark":"light";let e=N("message");e.textContent="Loading…";try{let n=document.getElementById("pack"),r=ru(N("image")),i=n?null:await yl(r===null),o=i?i.pack:await ln(Ho(n.textContent??"")),a=await As.make(r,o),l=i?new Ls(o.head):new Rs(o),u=new Ps(o),d=new cs(o,l,a,new ls(o.head,a.models,u),i,u);d.note=r||i?"":hp,a.lacksFloats&&(d.note=mp),e.textContent=d.note,i?.begin(d,l);let h=Number(new URLSearchParams(location.hash.slice(1)).get("level")??0);i||(await d.select(l.levels[h]?.trial??0),d.seek(l.levels[h]?l.levels[h].level.start:l.start)),ou(d)}catch(n){throw e.textContent=n instanceof Error?n.message:String(n),n}}dp();})();
