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
"use strict";(()=>{function Se(s){return Float64Array.from(s)}function Ie(s,e){let t=new Float64Array(16);for(let r=0;r<16;r+=4)for(let i=0;i<4;++i)t[r+i]=s[r]*e[i]+s[r+1]*e[4+i]+s[r+2]*e[8+i]+s[r+3]*e[12+i];return t}function nt(s,e=0){let[t,r,i]=[s[e],s[e+1],s[e+2]],n=Math.hypot(s[e+3],s[e+4],s[e+5],s[e+6])||1,[o,a,l,c]=[3,4,5,6].map(h=>s[e+h]/n);return Se([1-2*(l*l+c*c),2*(a*l-o*c),2*(a*c+o*l),t,2*(a*l+o*c),1-2*(a*a+c*c),2*(l*c-o*a),r,2*(a*c-o*l),2*(l*c+o*a),1-2*(a*a+l*l),i,0,0,0,1])}function va(s){let t=[[1,1,1],[1,-1,-1],[-1,1,-1],[-1,-1,1]].map(([h,u,m])=>Math.max(0,1+h*s[0]+u*s[5]+m*s[10])),[r,i,n,o]=t.map(h=>Math.sqrt(h)/2),a=t.indexOf(Math.max(...t)),l=[[1,s[9]-s[6],s[2]-s[8],s[4]-s[1]],[s[9]-s[6],1,s[1]+s[4],s[2]+s[8]],[s[2]-s[8],s[1]+s[4],1,s[6]+s[9]],[s[4]-s[1],s[2]+s[8],s[6]+s[9],1]],c=[r,i,n,o].map((h,u)=>h*(l[a][u]<0?-1:1));return[s[3],s[7],s[11],...c]}function Ze(s){let e=t=>-(s[t]*s[3]+s[4+t]*s[7]+s[8+t]*s[11]);return Se([s[0],s[4],s[8],e(0),s[1],s[5],s[9],e(1),s[2],s[6],s[10],e(2),0,0,0,1])}function Pn(s){return le([s[0],s[1],s[2]],it([s[4],s[5],s[6]],[s[8],s[9],s[10]]))}function ya(s){let e=[0,4,8].map(o=>[s[o],s[o+1],s[o+2]]),t=1/Pn(s),[r,i,n]=[it(e[1],e[2]),it(e[2],e[0]),it(e[0],e[1])];return Se([...[r,i,n].flatMap(o=>[o[0]*t,o[1]*t,o[2]*t,0]),0,0,0,1])}function Re(s,e){return[s[0]*e[0]+s[1]*e[1]+s[2]*e[2]+s[3],s[4]*e[0]+s[5]*e[1]+s[6]*e[2]+s[7],s[8]*e[0]+s[9]*e[1]+s[10]*e[2]+s[11]]}function Xr(s,e){return[le([s[0],s[1],s[2]],e),le([s[4],s[5],s[6]],e),le([s[8],s[9],s[10]],e)]}function Xs(s,e){return[le([s[0],s[4],s[8]],e),le([s[1],s[5],s[9]],e),le([s[2],s[6],s[10]],e)]}function de(s){return[s[3],s[7],s[11]]}function le(s,e){return s[0]*e[0]+s[1]*e[1]+s[2]*e[2]}function it(s,e){return[s[1]*e[2]-s[2]*e[1],s[2]*e[0]-s[0]*e[2],s[0]*e[1]-s[1]*e[0]]}function Me(s,e,t=1){return[s[0]+t*e[0],s[1]+t*e[1],s[2]+t*e[2]]}function wt(s){let e=Math.hypot(s[0],s[1],s[2])||1;return[s[0]/e,s[1]/e,s[2]/e]}function Ln(s,e,t=[0,0,1]){let r=wt(Me(s,e,-1)),i=it(t,r);Math.hypot(...i)<1e-6&&(i=it([1,0,0],r)),i=wt(i);let n=it(r,i);return Se([i[0],n[0],r[0],s[0],i[1],n[1],r[1],s[1],i[2],n[2],r[2],s[2],0,0,0,1])}function _a(s,e,t){let r=Math.min(e,.75*s)/(2*Math.tan(t/2)),i={cx:(s-1)/2,cy:(e-1)/2};return{width:s,height:e,fx:r,fy:r,...i,skew:0,near:.05,far:2e3}}function _s(s,e){let[t,r]=[Math.round(s.width*e),Math.round(s.height*e)];return{...s,width:t,height:r,fx:s.fx*e,fy:s.fy*e,cx:(s.cx+.5)*e-.5,cy:(s.cy+.5)*e-.5,skew:s.skew*e}}function rr(s,e){let{width:t,height:r,near:i,far:n}=s,o=n-i,a=e?1:-1;return Se([2*s.fx/t,2*s.skew/t,1-(2*s.cx+1)/t,0,0,-2*a*s.fy/r,a*(1-(2*s.cy+1)/r),0,0,0,-(n+i)/o,-2*n*i/o,0,0,-1,0])}function xt(s){return[0,1,2,3].flatMap(e=>[s[e],s[4+e],s[8+e],s[12+e]])}var[jr,sr,ba,wa,Kr,$r,Qr]=[3,4,5,8,9,10,11],uh=96,xa=2,hh=.25,mh=1e-5,dh=.001;function In(s,{time:e,puffs:t},r,i){let n=r-e;if(n<=0)return t;let o=Math.exp(-n/xa);return t.map(a=>{let l=a.slice(),c=0;for(let p=0;p<3;++p){let y=a[ba+p]*xa*(1-o);c+=y*y,l[p]+=y+i[p]*n,l[ba+p]*=o}l[2]=Math.max(l[2]-s.settling_speed*n,l[wa]),l[jr]=(Math.sqrt(a[jr])+hh*Math.sqrt(c))**2+2*s.diffusivity*n;let[h,u]=[Math.sqrt(l[jr]),l[2]-l[wa]],m=s.settling_speed*Math.sqrt(2/Math.PI)/h;return l[sr]*=Math.exp(-n*m*Math.exp(-.5*(u/h)**2)),l})}var js=class{constructor(e,t,r){this.spec=e;this.births=t;this.waterAt=r}spec;births;waterAt;state={time:0,puffs:[]};nextBirth=0;puffsAt(e){e<this.state.time&&([this.state,this.nextBirth]=[{time:0,puffs:[]},0]);let{births:t,spec:r}=this;for(;;){let i=t[this.nextBirth]?.time??1/0,o=!this.state.puffs.length||i<this.state.time+r.period+dh?i:this.state.time+r.period;if(o>e)return this.state;let a=In(r,this.state,o,this.waterAt(o));for(this.state={time:o,puffs:a.filter(l=>l[sr]>=mh)};t[this.nextBirth]?.time<=o;++this.nextBirth)this.add(t[this.nextBirth])}}add({puff:e}){let{puffs:t}=this.state;e?(t.length===uh&&t.splice(0,2,ph(t[0],t[1])),t.push(e)):t.length=0}};function ph(s,e){let t=s[sr]+e[sr],r=e[sr]/t,i=s.map((o,a)=>(1-r)*o+r*e[a]),n=[0,1,2].reduce((o,a)=>o+(e[a]-s[a])**2,0);return i[jr]+=r*(1-r)*n/3,[i[sr],i[Kr],i[$r]]=[t,s[Kr],e[$r]],i}var kn=class{constructor(e,t){this.head=e;this.data=t}head;data;numbers(e){let[t,r,i]=e;switch(i){case"f4":return new Float32Array(this.data,t,r);case"u4":return new Uint32Array(this.data,t,r);case"u2":return new Uint16Array(this.data,t,r);case"i2":return new Int16Array(this.data,t,r);case"i1":return new Int8Array(this.data,t,r);default:return new Uint8Array(this.data,t,r)}}};async function Aa(s){let e=new Blob([s]).stream().pipeThrough(new DecompressionStream("gzip"));return new Response(e).arrayBuffer()}var Ea="0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";function Sa(s){let e=new Uint8Array(128);for(let i=0;i<Ea.length;++i)e[Ea.charCodeAt(i)]=i;let t=Math.ceil(s.length/5),r=new DataView(new ArrayBuffer(4*t));for(let i=0;i<t;++i){let n=0;for(let o=5*i;o<5*i+5;++o)n=85*n+(o<s.length?e[s.charCodeAt(o)]:84);r.setUint32(4*i,n)}return new Uint8Array(r.buffer,0,s.length-t)}async function bs(s){let e=await Aa(s),t=new DataView(e).getUint32(0,!0),r=JSON.parse(new TextDecoder().decode(new Uint8Array(e,4,t)));return new kn(r,e.slice(4+t))}var Fn=class{constructor(e,t,r=[],i=[]){this.head=e;this.rows=t;this.removals=r;this.births=i}head;rows;removals;births;get columns(){return 7*this.head.bodies.length+this.head.signals.length}get end(){return this.head.start+Math.max(0,this.head.n-1)/this.head.rate}rowIndex(e){return Math.floor(this.rowPosition(e)+1e-6)}rowPosition(e){return Math.min(Math.max((e-this.head.start)*this.head.rate,0),this.head.n-1)}row(e){let t=this.columns,r=this.rowIndex(e),i=this.rows.slice(r*t,(r+1)*t),n=this.rowPosition(e)-r;if(n<1e-6||r+1>=this.head.n)return i;let o=(r+1)*t;for(let a=0;a<7*this.head.bodies.length;++a)i[a]+=n*(this.rows[o+a]-i[a]);return i}};async function Ma(s){let e=new Uint8Array(await Aa(s)),t=e.indexOf(10),r=JSON.parse(new TextDecoder().decode(e.subarray(0,t))),i=r.n,n=7*r.bodies.length+r.signals.length,o=e.subarray(t+1),a=Cn(o,i,n,c=>{let h=c%7<3?r.length:r.quaternion;return c<7*r.bodies.length?h:r.signals[c-7*r.bodies.length].step}),l=gh(r,o.subarray(4*i*n));return new Fn(r,a,l,vh(r,o.subarray(4*(i*n+5*l.length))))}function Cn(s,e,t,r){let i=new Float64Array(e*t);for(let n=0;n<t;++n){let o=r(n),a=0;for(let l=0,c=n*e;l<e;++l,++c){let h=s[c]|s[e*t+c]<<8|s[2*e*t+c]<<16;a=a+(h|s[3*e*t+c]<<24)|0,i[l*t+n]=a===-2147483648?NaN:a*o}}return i}function gh({sand:s},e){if(!s)return[];let t=Cn(e,s.n,5,r=>r<2?1:s.grain);return Array.from({length:s.n},(r,i)=>{let[n,o,a,l,c]=t.subarray(5*i,5*i+5);return{row:n,heap:o,position:Number.isNaN(a)?null:[a,l,c]}})}function vh({sediment:s},e){if(!s)return[];let{n:t,steps:r}=s,i=Cn(e,t,r.length,n=>r[n]);return Array.from({length:t},(n,o)=>{let[a,l,c,h,u,m,p,y,_,w,E]=i.subarray(r.length*o);if(Number.isNaN(p))return{time:a,puff:null};let x=new Array(Qr);return[c,h,u,m*m,p,y,_,w,E].forEach((M,S)=>x[S]=M),[x[Kr],x[$r]]=[a,l],{time:a,puff:x}})}function G(s){let e=document.getElementById(s);if(!e)throw new Error(`the page has no element ${s}`);return e}function K(s,e="",t=""){let r=document.createElement(s);return r.textContent=e,r.className=t,r}function Nn(s){return s==="ok"?"ok":s==="lost"||s.includes("error")?"bad":"other"}function _r(s,e){let t=-1;return s.levels.forEach(({trial:r,level:i},n)=>{r===s.trial&&i.start<=e+1e-6&&(t=n)}),t}function Ta(s){let e=s.levels.filter(({trial:t})=>t===s.trial);return e.length>0&&e.every(({level:t})=>t.status==="no motion")}var Ks=class{constructor(e,t){this.player=e;this.choose=t}player;choose;list=G("levels");current=-2;lastLevel=null;show(e){this.lastLevel!==this.player.levels.at(-1)?.level&&this.fill();let t=_r(this.player,e);if(t===this.current)return;this.current=t,this.list.querySelectorAll("button").forEach((n,o)=>{if(n.setAttribute("aria-current",String(o===t)),o!==t||this.list.contains(document.activeElement))return;let a=n.offsetTop-this.list.offsetTop;(a<this.list.scrollTop||a>this.list.scrollTop+this.list.clientHeight-24)&&(this.list.scrollTop=a-this.list.clientHeight/2)});let r=this.player.levels[t]?.level,i=G("now");i.textContent=r?`${r.label} · ${r.status}`:"",i.className=`badge ${r?Nn(r.status):""}`,G("why").textContent=r?.why??"",G("why").title=r?.why??""}mark(e,t){let r=G("marks");r.replaceChildren();let i=n=>`${100*(n-e)/Math.max(t-e,1e-9)}%`;for(let{trial:n,level:o}of this.player.levels){if(n!==this.player.trial)continue;let a=K("i","",Nn(o.status));a.style.left=i(o.start),a.style.width=i(e+o.end-o.start),a.title=`${o.label}: ${o.status}`,r.append(a)}}fill(){this.lastLevel=this.player.levels.at(-1)?.level,this.current=-2,G("levels-box").hidden=!this.lastLevel,this.list.replaceChildren(...this.player.levels.map(({level:e},t)=>{let r=K("button");r.append(K("span",e.label),K("span",e.status,Nn(e.status))),r.title=e.why??"",r.addEventListener("click",()=>this.choose(t));let i=K("li");return i.append(r),i}))}},$s=class{bars=[];constructor(e){let t=G("thrusters");for(let r of e.vehicles)for(let i of r.thrusters){let n=K("div"),[o,a,l]=[K("span","","bar"),K("i"),K("output")];o.append(a);let c=e.vehicles.length>1?`${r.name} ${i}`:i;n.append(K("span",c.replaceAll("_"," ")),o,l),t.append(n),this.bars.push({signal:`thrust/${r.name}/${i}`,bar:a,value:l})}}show(e){let t=!1;for(let{signal:r,bar:i,value:n}of this.bars){let o=e.signal(r);if(o===void 0)continue;t=!0;let a=50*Math.min(1,Math.abs(o));i.style.left=`${o<0?50-a:50}%`,i.style.width=`${a}%`,n.textContent=`${Math.round(100*o)||0} %`}G("thrusters-box").hidden=!t}};function Ra(s){let e=G("help");e.replaceChildren();let[t,r]=[K("div","","rows"),K("div","","columns")];t.tabIndex=0,t.append(r),e.append(t);for(let[n,o]of Object.entries(s)){let a=K("dl");for(let c of o)a.append(K("dt",c.keys),K("dd",c.action));let l=K("section");l.append(K("h2",n),a),r.append(l)}let i=K("button","Close");i.addEventListener("click",()=>e.close()),e.append(i)}function Qs(){let s=G("help");s.open?s.close():s.showModal()}var yh=100,_h=33,bh=["left","right"],Pa={surge:["forward","back"],sway:["right","left"],heave:["up","down"],yaw:["turn right","left"],roll:["roll right","left"],pitch:["pitch up","down"],lamps:["lamps brighter","darker"]},wh={yaw:"turn",sway:"left / right"},xh=6e3,Js=class{constructor(e){this.send=e;document.addEventListener("keyup",t=>{this.pressedKeys.delete(t.key.toLowerCase()),this.poll()}),window.addEventListener("blur",()=>{this.pressedKeys.clear(),this.poll()}),setInterval(()=>this.poll(),_h)}send;isOn=!1;mapping={};reason="";names={};reservedKeys=new Set;layout="";pressedKeys=new Set;sticks=[0,0,0,0];lastText="";sendTime=0;enable(e){this.isOn=e.pilot,this.mapping=e.pilot?e.mapping:{},this.reservedKeys=new Set(e.reserved),[this.names,this.reason]=[e.names,e.why];let t=JSON.stringify([e.pilot,e.sticks,e.names,e.why]);if(t===this.layout)return;this.layout=t;let i=[...bh.map((n,o)=>this.stick(n,2*o,e.sticks.slice(2*o,2*o+2))).filter(n=>n!==null),this.reason?K("p",this.reason,"why"):this.keyHints()];G("pilot").replaceChildren(...i.filter(n=>n!==null)),G("pilot").hidden=!e.pilot}isReserved(e){return this.isOn&&this.reservedKeys.has(e)}handlePilotKey(e){let t=e.key.toLowerCase();return e.shiftKey||!this.isReserved(t)?!1:(e.preventDefault(),t in this.mapping&&(this.pressedKeys.add(t),this.poll(),this.hideKeyHints()),!0)}help(){let e=this.keyPairs();return e.length?[...e.map(({axes:r,plusKeys:i,minusKeys:n})=>({keys:`${i||"–"}  ${n||"–"}`,action:`${this.namesOf(r)} +, −`})),{keys:"Shift",action:"with a letter: the page's own key"}]:[{keys:"–",action:this.reason||"this simulation has no pilot"}]}keyPairs(){let e=new Map;for(let[t,r]of Object.entries(this.mapping)){if(!r.trim())continue;let[i,n]=La(r),o=e.get(i)??["",""];o[n]+=(o[n]&&", ")+t,e.set(i,o)}return[...e].map(([t,[r,i]])=>({axes:t,plusKeys:r,minusKeys:i}))}namesOf(e){return e.split(" ").map(t=>{let r=this.names[t.replace("-","")];return r?t.replace(/[a-z]+\d*/,r):t}).join(" ")}keyHints(){let e=this.keyPairs();if(!e.length)return null;let t=K("div","","keyline");for(let{axes:n,plusKeys:o,minusKeys:a}of e){let l=K("span"),c=Pa[n]?.join(" / ")??this.namesOf(n);for(let h of[o,a])h&&l.append(K("kbd",h.toUpperCase()));l.append(` ${c}`),t.append(l)}let r=K("span");r.append(K("kbd","?")," all keys");let i=K("button","×");return i.setAttribute("aria-label","Hide the line of keys"),i.addEventListener("click",()=>t.remove()),t.append(r,i),t}hideKeyHints(){let e=G("pilot").querySelector(".keyline");e&&!e.classList.contains("leaves")&&(e.classList.add("leaves"),setTimeout(()=>e.remove(),xh))}input(){let e=navigator.getGamepads?.().find(t=>t!==null);return{keys:[...this.pressedKeys].sort(),axes:e?e.axes.map(On):[],buttons:e?e.buttons.map(({value:t})=>On(t)):[],sticks:this.sticks.map(On)}}poll(){if(!this.isOn)return;let e=this.input(),t=JSON.stringify(e),r=performance.now(),i=!e.keys.length&&![...e.axes,...e.buttons,...e.sticks].some(Boolean);if(t===this.lastText&&(i||r-this.sendTime<yh))return;let n=t!==this.lastText;this.lastText=t,this.sendTime=r,this.send({type:"input",...e},n)}stick(e,t,r){if(!r.some(u=>u.trim()))return null;let[i,n]=[K("div","",`thumb ${e}`),K("div","","label")],o=["↔","↕"];r.forEach((u,m)=>{u.trim()&&n.prepend(K("span",`${o[m]} ${this.stickWords(u)}`))});let[a,l]=[K("div","","stick"),K("i")];a.title=n.innerText,a.append(l),i.append(n,a);let c=(u,m)=>{let p=Math.max(1,Math.hypot(u,m));this.sticks[t]=u/p,this.sticks[t+1]=m/p,l.style.transform=`translate(${35*u/p}px, ${-35*m/p}px)`,this.poll()},h=u=>{if(!a.hasPointerCapture(u.pointerId))return;let m=a.getBoundingClientRect(),p=m.width/2;c((u.clientX-m.left-p)/p,-(u.clientY-m.top-p)/p)};a.addEventListener("pointerdown",u=>{a.setPointerCapture(u.pointerId),h(u)}),a.addEventListener("pointermove",h);for(let u of["pointerup","pointercancel"])a.addEventListener(u,()=>c(0,0));return i}stickWords(e){let[t]=La(e);return wh[t]??Pa[t]?.join(" / ")??this.namesOf(t)}};function La(s){let e=s.trim().split(/\s+/),t=e[0].startsWith("-");return[e.map(i=>(i.startsWith("-")!==t?"-":"")+i.replace(/^[+-]+/,"")).join(" "),t?1:0]}function On(s){return Math.round(s*1e3)/1e3}var Eh="uplot",Ah="u-hz",Sh="u-vt",Mh="u-title",Th="u-wrap",Rh="u-under",Ph="u-over",Lh="u-axis",xr="u-off",Ih="u-select",kh="u-cursor-x",Fh="u-cursor-y",Ch="u-cursor-pt",Nh="u-legend",Oh="u-live",Dh="u-inline",Uh="u-series",Vh="u-marker",Ia="u-label",Bh="u-value",xs="width",Es="height";var ka="bottom",Jr="left",Dn="right",eo="#000",Fa=eo+"0",Un="mousemove",Ca="mousedown",Vn="mouseup",Na="mouseenter",Oa="mouseleave",Da="dblclick",zh="resize",Gh="scroll",Ua="change",si="dppxchange",to="--",ns=typeof window<"u",Hn=ns?document:null,es=ns?window:null,Wh=ns?navigator:null,ce,Zs;function Yn(){let s=devicePixelRatio;ce!=s&&(ce=s,Zs&&Xn(Ua,Zs,Yn),Zs=matchMedia(`(min-resolution: ${ce-.001}dppx) and (max-resolution: ${ce+.001}dppx)`),Er(Ua,Zs,Yn),es.dispatchEvent(new CustomEvent(si)))}function ht(s,e){if(e!=null){let t=s.classList;!t.contains(e)&&t.add(e)}}function qn(s,e){let t=s.classList;t.contains(e)&&t.remove(e)}function we(s,e,t){s.style[e]=t+"px"}function Lt(s,e,t,r){let i=Hn.createElement(s);return e!=null&&ht(i,e),t?.insertBefore(i,r),i}function Et(s,e){return Lt("div",s,e)}var Va=new WeakMap;function Gt(s,e,t,r,i){let n="translate("+e+"px,"+t+"px)",o=Va.get(s);n!=o&&(s.style.transform=n,Va.set(s,n),e<0||t<0||e>r||t>i?ht(s,xr):qn(s,xr))}var Ba=new WeakMap;function za(s,e,t){let r=e+t,i=Ba.get(s);r!=i&&(Ba.set(s,r),s.style.background=e,s.style.borderColor=t)}var Ga=new WeakMap;function Wa(s,e,t,r){let i=e+""+t,n=Ga.get(s);i!=n&&(Ga.set(s,i),s.style.height=t+"px",s.style.width=e+"px",s.style.marginLeft=r?-e/2+"px":0,s.style.marginTop=r?-t/2+"px":0)}var ro={passive:!0},Hh={...ro,capture:!0};function Er(s,e,t,r){e.addEventListener(s,t,r?Hh:ro)}function Xn(s,e,t,r){e.removeEventListener(s,t,ro)}ns&&Yn();function It(s,e,t,r){let i;t=t||0,r=r||e.length-1;let n=r<=2147483647;for(;r-t>1;)i=n?t+r>>1:mt((t+r)/2),e[i]<s?t=i:r=i;return s-e[t]<=e[r]-s?t:r}function vl(s){return(t,r,i)=>{let n=-1,o=-1;for(let a=r;a<=i;a++)if(s(t[a])){n=a;break}for(let a=i;a>=r;a--)if(s(t[a])){o=a;break}return[n,o]}}var yl=s=>s!=null,_l=s=>s!=null&&s>0,oi=vl(yl),Yh=vl(_l);function qh(s,e,t,r=0,i=!1){let n=i?Yh:oi,o=i?_l:yl;[e,t]=n(s,e,t);let a=s[e],l=s[e];if(e>-1)if(r==1)a=s[e],l=s[t];else if(r==-1)a=s[t],l=s[e];else for(let c=e;c<=t;c++){let h=s[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??pe,l??-pe]}function ai(s,e,t,r){let i=qa(s),n=qa(e);s==e&&(i==-1?(s*=t,e/=t):(s/=t,e*=t));let o=t==10?qt:bl,a=i==1?mt:At,l=n==1?At:mt,c=a(o(De(s))),h=l(o(De(e))),u=ts(t,c),m=ts(t,h);return t==10&&(c<0&&(u=ge(u,-c)),h<0&&(m=ge(m,-h))),r||t==2?(s=u*i,e=m*n):(s=Al(s,u),e=li(e,m)),[s,e]}function so(s,e,t,r){let i=ai(s,e,t,r);return s==0&&(i[0]=0),e==0&&(i[1]=0),i}var io=.1,Ha={mode:3,pad:io},Ss={pad:0,soft:null,mode:0},Xh={min:Ss,max:Ss};function ii(s,e,t,r){return ci(t)?Ya(s,e,t):(Ss.pad=t,Ss.soft=r?0:null,Ss.mode=r?3:0,Ya(s,e,Xh))}function oe(s,e){return s??e}function jh(s,e,t){for(e=oe(e,0),t=oe(t,s.length-1);e<=t;){if(s[e]!=null)return!0;e++}return!1}function Ya(s,e,t){let r=t.min,i=t.max,n=oe(r.pad,0),o=oe(i.pad,0),a=oe(r.hard,-pe),l=oe(i.hard,pe),c=oe(r.soft,pe),h=oe(i.soft,-pe),u=oe(r.mode,0),m=oe(i.mode,0),p=e-s,y=qt(p),_=et(De(s),De(e)),w=qt(_),E=De(w-y);(p<1e-24||E>10)&&(p=0,(s==0||e==0)&&(p=1e-24,u==2&&c!=pe&&(n=0),m==2&&h!=-pe&&(o=0)));let x=p||_||1e3,M=qt(x),S=ts(10,mt(M)),F=x*(p==0?s==0?.1:1:n),L=ge(Al(s-F,S/10),24),C=s>=c&&(u==1||u==3&&L<=c||u==2&&L>=c)?c:pe,U=et(a,L<C&&s>=C?C:kt(C,L)),V=x*(p==0?e==0?.1:1:o),N=ge(li(e+V,S/10),24),R=e<=h&&(m==1||m==3&&N>=h||m==2&&N<=h)?h:-pe,H=kt(l,N>R&&e<=R?R:et(R,N));return U==H&&U==0&&(H=100),[U,H]}var Kh=new Intl.NumberFormat(ns?Wh.language:"en-US"),no=s=>Kh.format(s),dt=Math,ri=dt.PI,De=dt.abs,mt=dt.floor,Oe=dt.round,At=dt.ceil,kt=dt.min,et=dt.max,ts=dt.pow,qa=dt.sign,qt=dt.log10,bl=dt.log2,$h=(s,e=1)=>dt.sinh(s)*e,Bn=(s,e=1)=>dt.asinh(s/e),pe=1/0;function Xa(s){return(qt((s^s>>31)-(s>>31))|0)+1}function jn(s,e,t){return kt(et(s,e),t)}function wl(s){return typeof s=="function"}function se(s){return wl(s)?s:()=>s}var Qh=()=>{},xl=s=>s,El=(s,e)=>e,Jh=s=>null,ja=s=>!0,Ka=(s,e)=>s==e,Zh=/\.\d*?(?=9{6,}|0{6,})/gm,Ar=s=>{if(Ml(s)||nr.has(s))return s;let e=`${s}`,t=e.match(Zh);if(t==null)return s;let r=t[0].length-1;if(e.indexOf("e-")!=-1){let[i,n]=e.split("e");return+`${Ar(i)}e${n}`}return ge(s,r)};function br(s,e){return Ar(ge(Ar(s/e))*e)}function li(s,e){return Ar(At(Ar(s/e))*e)}function Al(s,e){return Ar(mt(Ar(s/e))*e)}function ge(s,e=0){if(Ml(s))return s;let t=10**e,r=s*t*(1+Number.EPSILON);return Oe(r)/t}var nr=new Map;function Sl(s){return((""+s).split(".")[1]||"").length}function Ts(s,e,t,r){let i=[],n=r.map(Sl);for(let o=e;o<t;o++){let a=De(o),l=ge(ts(s,o),a);for(let c=0;c<r.length;c++){let h=s==10?+`${r[c]}e${o}`:r[c]*l,u=(o>=0?0:a)+(o>=n[c]?0:n[c]),m=s==10?h:ge(h,u);i.push(m),nr.set(m,u)}}return i}var Ms={},oo=[],rs=[null,null],ir=Array.isArray,Ml=Number.isInteger,em=s=>s===void 0;function $a(s){return typeof s=="string"}function ci(s){let e=!1;if(s!=null){let t=s.constructor;e=t==null||t==Object}return e}function tm(s){return s!=null&&typeof s=="object"}var rm=Object.getPrototypeOf(Uint8Array),Tl="__proto__";function ss(s,e=ci){let t;if(ir(s)){let r=s.find(i=>i!=null);if(ir(r)||e(r)){t=Array(s.length);for(let i=0;i<s.length;i++)t[i]=ss(s[i],e)}else t=s.slice()}else if(s instanceof rm)t=s.slice();else if(e(s)){t={};for(let r in s)r!=Tl&&(t[r]=ss(s[r],e))}else t=s;return t}function Fe(s){let e=arguments;for(let t=1;t<e.length;t++){let r=e[t];for(let i in r)i!=Tl&&(ci(s[i])?Fe(s[i],ss(r[i])):s[i]=ss(r[i]))}return s}var sm=0,im=1,nm=2;function om(s,e,t){for(let r=0,i,n=-1;r<e.length;r++){let o=e[r];if(o>n){for(i=o-1;i>=0&&s[i]==null;)s[i--]=null;for(i=o+1;i<t&&s[i]==null;)s[n=i++]=null}}}function am(s,e){if(fm(s)){let o=s[0].slice();for(let a=1;a<s.length;a++)o.push(...s[a].slice(1));return um(o[0])||(o=cm(o)),o}let t=new Set;for(let o=0;o<s.length;o++){let l=s[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let r=[Array.from(t).sort((o,a)=>o-a)],i=r[0].length,n=new Map;for(let o=0;o<i;o++)n.set(r[0][o],o);for(let o=0;o<s.length;o++){let a=s[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(i).fill(void 0),m=e?e[o][c]:im,p=[];for(let y=0;y<h.length;y++){let _=h[y],w=n.get(l[y]);_===null?m!=sm&&(u[w]=_,m==nm&&p.push(w)):u[w]=_}om(u,p,i),r.push(u)}}return r}var lm=typeof queueMicrotask>"u"?s=>Promise.resolve().then(s):queueMicrotask;function cm(s){let e=s[0],t=e.length,r=Array(t);for(let n=0;n<r.length;n++)r[n]=n;r.sort((n,o)=>e[n]-e[o]);let i=[];for(let n=0;n<s.length;n++){let o=s[n],a=Array(t);for(let l=0;l<t;l++)a[l]=o[r[l]];i.push(a)}return i}function fm(s){let e=s[0][0],t=e.length;for(let r=1;r<s.length;r++){let i=s[r][0];if(i.length!=t)return!1;if(i!=e){for(let n=0;n<t;n++)if(i[n]!=e[n])return!1}}return!0}function um(s,e=100){let t=s.length;if(t<=1)return!0;let r=0,i=t-1;for(;r<=i&&s[r]==null;)r++;for(;i>=r&&s[i]==null;)i--;if(i<=r)return!0;let n=et(1,mt((i-r+1)/e));for(let o=s[r],a=r+n;a<=i;a+=n){let l=s[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var Rl=["January","February","March","April","May","June","July","August","September","October","November","December"],Pl=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Ll(s){return s.slice(0,3)}var hm=Pl.map(Ll),mm=Rl.map(Ll),dm={MMMM:Rl,MMM:mm,WWWW:Pl,WWW:hm};function ws(s){return(s<10?"0":"")+s}function pm(s){return(s<10?"00":s<100?"0":"")+s}var gm={YYYY:s=>s.getFullYear(),YY:s=>(s.getFullYear()+"").slice(2),MMMM:(s,e)=>e.MMMM[s.getMonth()],MMM:(s,e)=>e.MMM[s.getMonth()],MM:s=>ws(s.getMonth()+1),M:s=>s.getMonth()+1,DD:s=>ws(s.getDate()),D:s=>s.getDate(),WWWW:(s,e)=>e.WWWW[s.getDay()],WWW:(s,e)=>e.WWW[s.getDay()],HH:s=>ws(s.getHours()),H:s=>s.getHours(),h:s=>{let e=s.getHours();return e==0?12:e>12?e-12:e},AA:s=>s.getHours()>=12?"PM":"AM",aa:s=>s.getHours()>=12?"pm":"am",a:s=>s.getHours()>=12?"p":"a",mm:s=>ws(s.getMinutes()),m:s=>s.getMinutes(),ss:s=>ws(s.getSeconds()),s:s=>s.getSeconds(),fff:s=>pm(s.getMilliseconds())};function ao(s,e){e=e||dm;let t=[],r=/\{([a-z]+)\}|[^{]+/gi,i;for(;i=r.exec(s);)t.push(i[0][0]=="{"?gm[i[1]]:i[0]);return n=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](n,e);return o}}var vm=new Intl.DateTimeFormat().resolvedOptions().timeZone;function ym(s,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+s+s.getTimezoneOffset()*6e4):e==vm?t=s:(t=new Date(s.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(s.getMilliseconds())),t}var Il=s=>s%1==0,ni=[1,2,2.5,5],_m=Ts(10,-32,0,ni),kl=Ts(10,0,32,ni),bm=kl.filter(Il),wr=_m.concat(kl),lo=`
`,Fl="{YYYY}",Qa=lo+Fl,Cl="{M}/{D}",As=lo+Cl,ei=As+"/{YY}",Nl="{aa}",wm="{h}:{mm}",Zr=wm+Nl,Ja=lo+Zr,Za=":{ss}",ue=null;function Ol(s){let e=s*1e3,t=e*60,r=t*60,i=r*24,n=i*30,o=i*365,l=(s==1?Ts(10,0,3,ni).filter(Il):Ts(10,-3,0,ni)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,r,r*2,r*3,r*4,r*6,r*8,r*12,i,i*2,i*3,i*4,i*5,i*6,i*7,i*8,i*9,i*10,i*15,n,n*2,n*3,n*4,n*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,Fl,ue,ue,ue,ue,ue,ue,1],[i*28,"{MMM}",Qa,ue,ue,ue,ue,ue,1],[i,Cl,Qa,ue,ue,ue,ue,ue,1],[r,"{h}"+Nl,ei,ue,As,ue,ue,ue,1],[t,Zr,ei,ue,As,ue,ue,ue,1],[e,Za,ei+" "+Zr,ue,As+" "+Zr,ue,Ja,ue,1],[s,Za+".{fff}",ei+" "+Zr,ue,As+" "+Zr,ue,Ja,ue,1]];function h(u){return(m,p,y,_,w,E)=>{let x=[],M=w>=o,S=w>=n&&w<o,F=u(y),L=ge(F*s,3),C=zn(F.getFullYear(),M?0:F.getMonth(),S||M?1:F.getDate()),U=ge(C*s,3);if(S||M){let V=S?w/n:0,N=M?w/o:0,R=L==U?L:ge(zn(C.getFullYear()+N,C.getMonth()+V,1)*s,3),H=new Date(Oe(R/s)),z=H.getFullYear(),j=H.getMonth();for(let W=0;R<=_;W++){let Z=zn(z+N*W,j+V*W,1),X=Z-u(ge(Z*s,3));R=ge((+Z+X)*s,3),R<=_&&x.push(R)}}else{let V=w>=i?i:w,N=mt(y)-mt(L),R=U+N+li(L-U,V);x.push(R);let H=u(R),z=H.getHours()+H.getMinutes()/t+H.getSeconds()/r,j=w/r,W=m.axes[p]._space,Z=E/W;for(;R=ge(R+w,s==1?0:3),!(R>_);)if(j>1){let X=mt(ge(z+j,6))%24,ie=u(R).getHours()-X;ie>1&&(ie=-1),R-=ie*r,z=(z+j)%24;let he=x[x.length-1];ge((R-he)/w,3)*Z>=.7&&x.push(R)}else x.push(R)}return x}}return[l,c,h]}var[xm,Em,Am]=Ol(1),[Sm,Mm,Tm]=Ol(.001);Ts(2,-53,53,[1]);function el(s,e){return s.map(t=>t.map((r,i)=>i==0||i==8||r==null?r:e(i==1||t[8]==0?r:t[1]+r)))}function tl(s,e){return(t,r,i,n,o)=>{let a=e.find(y=>o>=y[0])||e[e.length-1],l,c,h,u,m,p;return r.map(y=>{let _=s(y),w=_.getFullYear(),E=_.getMonth(),x=_.getDate(),M=_.getHours(),S=_.getMinutes(),F=_.getSeconds(),L=w!=l&&a[2]||E!=c&&a[3]||x!=h&&a[4]||M!=u&&a[5]||S!=m&&a[6]||F!=p&&a[7]||a[1];return l=w,c=E,h=x,u=M,m=S,p=F,L(_)})}}function Rm(s,e){let t=ao(e);return(r,i,n,o,a)=>i.map(l=>t(s(l)))}function zn(s,e,t){return new Date(s,e,t)}function rl(s,e){return e(s)}var Pm="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function sl(s,e){return(t,r,i,n)=>n==null?to:e(s(r))}function Lm(s,e){let t=s.series[e];return t.width?t.stroke(s,e):t.points.width?t.points.stroke(s,e):null}function Im(s,e){return s.series[e].fill(s,e)}var km={show:!0,live:!0,isolate:!1,mount:Qh,markers:{show:!0,width:2,stroke:Lm,fill:Im,dash:"solid"},idx:null,idxs:null,values:[]};function Fm(s,e){let t=s.cursor.points,r=Et(),i=t.size(s,e);we(r,xs,i),we(r,Es,i);let n=i/-2;we(r,"marginLeft",n),we(r,"marginTop",n);let o=t.width(s,e,i);return o&&we(r,"borderWidth",o),r}function Cm(s,e){let t=s.series[e].points;return t._fill||t._stroke}function Nm(s,e){let t=s.series[e].points;return t._stroke||t._fill}function Om(s,e){return s.series[e].points.size}var Gn=[0,0];function Dm(s,e,t){return Gn[0]=e,Gn[1]=t,Gn}function ti(s,e,t,r=!0){return i=>{i.button==0&&(!r||i.target==e)&&t(i)}}function Wn(s,e,t,r=!0){return i=>{(!r||i.target==e)&&t(i)}}var Um={show:!0,x:!0,y:!0,lock:!1,move:Dm,points:{one:!1,show:Fm,size:Om,width:0,stroke:Nm,fill:Cm},bind:{mousedown:ti,mouseup:ti,click:ti,dblclick:ti,mousemove:Wn,mouseleave:Wn,mouseenter:Wn},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(s,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(s,e,t,r,i)=>r-i,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Dl={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},co=Fe({},Dl,{filter:El}),Ul=Fe({},co,{size:10}),Vl=Fe({},Dl,{show:!1}),fo='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Bl="bold "+fo,zl=1.5,il={show:!0,scale:"x",stroke:eo,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Bl,side:2,grid:co,ticks:Ul,border:Vl,font:fo,lineGap:zl,rotate:0},Vm="Value",Bm="Time",nl={show:!0,scale:"x",auto:!1,sorted:1,min:pe,max:-pe,idxs:[]};function zm(s,e,t,r,i){return e.map(n=>n==null?"":no(n))}function Gm(s,e,t,r,i,n,o){let a=[],l=nr.get(i)||0;t=o?t:ge(li(t,i),l);for(let c=t;c<=r;c=ge(c+i,l))a.push(Object.is(c,-0)?0:c);return a}function Kn(s,e,t,r,i,n,o){let a=[],l=s.scales[s.axes[e].scale].log,c=l==10?qt:bl,h=mt(c(t));i=ts(l,h),l==10&&(i=wr[It(i,wr)]);let u=t,m=i*l;l==10&&(m=wr[It(m,wr)]);do a.push(u),u=u+i,l==10&&!nr.has(u)&&(u=ge(u,nr.get(i))),u>=m&&(i=u,m=i*l,l==10&&(m=wr[It(m,wr)]));while(u<=r);return a}function Wm(s,e,t,r,i,n,o){let l=s.scales[s.axes[e].scale].asinh,c=r>l?Kn(s,e,et(l,t),r,i):[l],h=r>=0&&t<=0?[0]:[];return(t<-l?Kn(s,e,et(l,-r),-t,i):[l]).reverse().map(m=>-m).concat(h,c)}var Gl=/./,Hm=/[12357]/,Ym=/[125]/,ol=/1/,$n=(s,e,t,r)=>s.map((i,n)=>e==4&&i==0||n%r==0&&t.test(i.toExponential()[i<0?1:0])?i:null);function qm(s,e,t,r,i){let n=s.axes[t],o=n.scale,a=s.scales[o],l=s.valToPos,c=n._space,h=l(10,o),u=l(9,o)-h>=c?Gl:l(7,o)-h>=c?Hm:l(5,o)-h>=c?Ym:ol;if(u==ol){let m=De(l(1,o)-h);if(m<c)return $n(e.slice().reverse(),a.distr,u,At(c/m)).reverse()}return $n(e,a.distr,u,1)}function Xm(s,e,t,r,i){let n=s.axes[t],o=n.scale,a=n._space,l=s.valToPos,c=De(l(1,o)-l(2,o));return c<a?$n(e.slice().reverse(),3,Gl,At(a/c)).reverse():e}function jm(s,e,t,r){return r==null?to:e==null?"":no(e)}var al={show:!0,scale:"y",stroke:eo,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Bl,side:3,grid:co,ticks:Ul,border:Vl,font:fo,lineGap:zl,rotate:0};function Km(s,e){let t=3+(s||1)*2;return ge(t*e,3)}function $m(s,e){let{scale:t,idxs:r}=s.series[0],i=s._data[0],n=s.valToPos(i[r[0]],t,!0),o=s.valToPos(i[r[1]],t,!0),a=De(o-n),l=s.series[e],c=a/(l.points.space*ce);return r[1]-r[0]<=c}var ll={scale:null,auto:!0,sorted:0,min:pe,max:-pe},Wl=(s,e,t,r,i)=>i,cl={show:!0,auto:!0,sorted:0,gaps:Wl,alpha:1,facets:[Fe({},ll,{scale:"x"}),Fe({},ll,{scale:"y"})]},fl={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:Wl,alpha:1,points:{show:$m,filter:null},values:null,min:pe,max:-pe,idxs:[],path:null,clip:null};function Qm(s,e,t,r,i){return t/10}var Hl={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Jm=Fe({},Hl,{time:!1,ori:1}),ul={};function Yl(s,e){let t=ul[s];return t||(t={key:s,plots:[],sub(r){t.plots.push(r)},unsub(r){t.plots=t.plots.filter(i=>i!=r)},pub(r,i,n,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=i&&t.plots[h].pub(r,i,n,o,a,l,c)}},s!=null&&(ul[s]=t)),t}var is=1,Qn=2;function Sr(s,e,t){let r=s.mode,i=s.series[e],n=r==2?s._data[e]:s._data,o=s.scales,a=s.bbox,l=n[0],c=r==2?n[1]:n[e],h=r==2?o[i.facets[0].scale]:o[s.series[0].scale],u=r==2?o[i.facets[1].scale]:o[i.scale],m=a.left,p=a.top,y=a.width,_=a.height,w=s.valToPosH,E=s.valToPosV;return h.ori==0?t(i,l,c,h,u,w,E,m,p,y,_,ui,os,mi,Xl,Kl):t(i,l,c,h,u,E,w,p,m,_,y,hi,as,mo,jl,$l)}function uo(s,e){let t=0,r=0,i=oe(s.bands,oo);for(let n=0;n<i.length;n++){let o=i[n];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?r|=1:r|=2)}return[t,r==1?-1:r==2?1:r==3?2:0]}function Zm(s,e,t,r,i){let n=s.mode,o=s.series[e],a=n==2?o.facets[1].scale:o.scale,l=s.scales[a];return i==-1?l.min:i==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Xt(s,e,t,r,i,n){return Sr(s,e,(o,a,l,c,h,u,m,p,y,_,w)=>{let E=o.pxRound,x=c.dir*(c.ori==0?1:-1),M=c.ori==0?os:as,S,F;x==1?(S=t,F=r):(S=r,F=t);let L=E(u(a[S],c,_,p)),C=E(m(l[S],h,w,y)),U=E(u(a[F],c,_,p)),V=E(m(n==1?h.max:h.min,h,w,y)),N=new Path2D(i);return M(N,U,V),M(N,L,V),M(N,L,C),N})}function fi(s,e,t,r,i,n){let o=null;if(s.length>0){o=new Path2D;let a=e==0?mi:mo,l=t;for(let u=0;u<s.length;u++){let m=s[u];if(m[1]>m[0]){let p=m[0]-l;p>0&&a(o,l,r,p,r+n),l=m[1]}}let c=t+i-l,h=10;c>0&&a(o,l,r-h/2,c,r+n+h)}return o}function ed(s,e,t){let r=s[s.length-1];r&&r[0]==e?r[1]=t:s.push([e,t])}function ho(s,e,t,r,i,n,o){let a=[],l=s.length;for(let c=i==1?t:r;c>=t&&c<=r;c+=i)if(e[c]===null){let u=c,m=c;if(i==1)for(;++c<=r&&e[c]===null;)m=c;else for(;--c>=t&&e[c]===null;)m=c;let p=n(s[u]),y=m==u?p:n(s[m]),_=u-i;p=o<=0&&_>=0&&_<l?n(s[_]):p;let E=m+i;y=o>=0&&E>=0&&E<l?n(s[E]):y,y>=p&&a.push([p,y])}return a}function hl(s){return s==0?xl:s==1?Oe:e=>br(e,s)}function ql(s){let e=s==0?ui:hi,t=s==0?(i,n,o,a,l,c)=>{i.arcTo(n,o,a,l,c)}:(i,n,o,a,l,c)=>{i.arcTo(o,n,l,a,c)},r=s==0?(i,n,o,a,l)=>{i.rect(n,o,a,l)}:(i,n,o,a,l)=>{i.rect(o,n,l,a)};return(i,n,o,a,l,c=0,h=0)=>{c==0&&h==0?r(i,n,o,a,l):(c=kt(c,a/2,l/2),h=kt(h,a/2,l/2),e(i,n+c,o),t(i,n+a,o,n+a,o+l,c),t(i,n+a,o+l,n,o+l,h),t(i,n,o+l,n,o,h),t(i,n,o,n+a,o,c),i.closePath())}}var ui=(s,e,t)=>{s.moveTo(e,t)},hi=(s,e,t)=>{s.moveTo(t,e)},os=(s,e,t)=>{s.lineTo(e,t)},as=(s,e,t)=>{s.lineTo(t,e)},mi=ql(0),mo=ql(1),Xl=(s,e,t,r,i,n)=>{s.arc(e,t,r,i,n)},jl=(s,e,t,r,i,n)=>{s.arc(t,e,r,i,n)},Kl=(s,e,t,r,i,n,o)=>{s.bezierCurveTo(e,t,r,i,n,o)},$l=(s,e,t,r,i,n,o)=>{s.bezierCurveTo(t,e,i,r,o,n)};function Ql(s){return(e,t,r,i,n)=>Sr(e,t,(o,a,l,c,h,u,m,p,y,_,w)=>{let{pxRound:E,points:x}=o,M,S;c.ori==0?(M=ui,S=Xl):(M=hi,S=jl);let F=ge(x.width*ce,3),L=(x.size-x.width)/2*ce,C=ge(L*2,3),U=new Path2D,V=new Path2D,{left:N,top:R,width:H,height:z}=e.bbox;mi(V,N-C,R-C,H+C*2,z+C*2);let j=W=>{if(l[W]!=null){let Z=E(u(a[W],c,_,p)),X=E(m(l[W],h,w,y));M(U,Z+L,X),S(U,Z,X,L,0,ri*2)}};if(n)n.forEach(j);else for(let W=r;W<=i;W++)j(W);return{stroke:F>0?U:null,fill:U,clip:V,flags:is|Qn}})}function Jl(s){return(e,t,r,i,n,o)=>{r!=i&&(n!=r&&o!=r&&s(e,t,r),n!=i&&o!=i&&s(e,t,i),s(e,t,o))}}var td=Jl(os),rd=Jl(as);function Zl(s){let e=oe(s?.alignGaps,0);return(t,r,i,n)=>Sr(t,r,(o,a,l,c,h,u,m,p,y,_,w)=>{[i,n]=oi(l,i,n);let E=o.pxRound,x=z=>E(u(z,c,_,p)),M=z=>E(m(z,h,w,y)),S,F;c.ori==0?(S=os,F=td):(S=as,F=rd);let L=c.dir*(c.ori==0?1:-1),C={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:is},U=C.stroke,V=!1;if(n-i>=_*4){let z=Y=>t.posToVal(Y,c.key,!0),j=null,W=null,Z,X,tt,xe=x(a[L==1?i:n]),ie=x(a[i]),he=x(a[n]),te=z(L==1?ie+1:he-1);for(let Y=L==1?i:n;Y>=i&&Y<=n;Y+=L){let Ce=a[Y],Ee=(L==1?Ce<te:Ce>te)?xe:x(Ce),fe=l[Y];Ee==xe?fe!=null?(X=fe,j==null?(S(U,Ee,M(X)),Z=j=W=X):X<j?j=X:X>W&&(W=X)):fe===null&&(V=!0):(j!=null&&F(U,xe,M(j),M(W),M(Z),M(X)),fe!=null?(X=fe,S(U,Ee,M(X)),j=W=Z=X):(j=W=null,fe===null&&(V=!0)),xe=Ee,te=z(xe+L))}j!=null&&j!=W&&tt!=xe&&F(U,xe,M(j),M(W),M(Z),M(X))}else for(let z=L==1?i:n;z>=i&&z<=n;z+=L){let j=l[z];j===null?V=!0:j!=null&&S(U,x(a[z]),M(j))}let[R,H]=uo(t,r);if(o.fill!=null||R!=0){let z=C.fill=new Path2D(U),j=o.fillTo(t,r,o.min,o.max,R),W=M(j),Z=x(a[i]),X=x(a[n]);L==-1&&([X,Z]=[Z,X]),S(z,X,W),S(z,Z,W)}if(!o.spanGaps){let z=[];V&&z.push(...ho(a,l,i,n,L,x,e)),C.gaps=z=o.gaps(t,r,i,n,z),C.clip=fi(z,c.ori,p,y,_,w)}return H!=0&&(C.band=H==2?[Xt(t,r,i,n,U,-1),Xt(t,r,i,n,U,1)]:Xt(t,r,i,n,U,H)),C})}function sd(s){let e=oe(s.align,1),t=oe(s.ascDesc,!1),r=oe(s.alignGaps,0),i=oe(s.extend,!1);return(n,o,a,l)=>Sr(n,o,(c,h,u,m,p,y,_,w,E,x,M)=>{[a,l]=oi(u,a,l);let S=c.pxRound,{left:F,width:L}=n.bbox,C=ie=>S(y(ie,m,x,w)),U=ie=>S(_(ie,p,M,E)),V=m.ori==0?os:as,N={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:is},R=N.stroke,H=m.dir*(m.ori==0?1:-1),z=U(u[H==1?a:l]),j=C(h[H==1?a:l]),W=j,Z=j;i&&e==-1&&(Z=F,V(R,Z,z)),V(R,j,z);for(let ie=H==1?a:l;ie>=a&&ie<=l;ie+=H){let he=u[ie];if(he==null)continue;let te=C(h[ie]),Y=U(he);e==1?V(R,te,z):V(R,W,Y),V(R,te,Y),z=Y,W=te}let X=W;i&&e==1&&(X=F+L,V(R,X,z));let[tt,xe]=uo(n,o);if(c.fill!=null||tt!=0){let ie=N.fill=new Path2D(R),he=c.fillTo(n,o,c.min,c.max,tt),te=U(he);V(ie,X,te),V(ie,Z,te)}if(!c.spanGaps){let ie=[];ie.push(...ho(h,u,a,l,H,C,r));let he=c.width*ce/2,te=t||e==1?he:-he,Y=t||e==-1?-he:he;ie.forEach(Ce=>{Ce[0]+=te,Ce[1]+=Y}),N.gaps=ie=c.gaps(n,o,a,l,ie),N.clip=fi(ie,m.ori,w,E,x,M)}return xe!=0&&(N.band=xe==2?[Xt(n,o,a,l,R,-1),Xt(n,o,a,l,R,1)]:Xt(n,o,a,l,R,xe)),N})}function ml(s,e,t,r,i,n,o=pe){if(s.length>1){let a=null;for(let l=0,c=1/0;l<s.length;l++)if(e[l]!==void 0){if(a!=null){let h=De(s[l]-s[a]);h<c&&(c=h,o=De(t(s[l],r,i,n)-t(s[a],r,i,n)))}a=l}}return o}function id(s){s=s||Ms;let e=oe(s.size,[.6,pe,1]),t=s.align||0,r=s.gap||0,i=s.radius;i=i==null?[0,0]:typeof i=="number"?[i,0]:i;let n=se(i),o=1-e[0],a=oe(e[1],pe),l=oe(e[2],1),c=oe(s.disp,Ms),h=oe(s.each,p=>{}),{fill:u,stroke:m}=c;return(p,y,_,w)=>Sr(p,y,(E,x,M,S,F,L,C,U,V,N,R)=>{let H=E.pxRound,z=t,j=r*ce,W=a*ce,Z=l*ce,X,tt;S.ori==0?[X,tt]=n(p,y):[tt,X]=n(p,y);let xe=S.dir*(S.ori==0?1:-1),ie=S.ori==0?mi:mo,he=S.ori==0?h:(D,ve,Ne,Ir,ur,Ot,hr)=>{h(D,ve,Ne,ur,Ir,hr,Ot)},te=oe(p.bands,oo).find(D=>D.series[0]==y),Y=te!=null?te.dir:0,Ce=E.fillTo(p,y,E.min,E.max,Y),je=H(C(Ce,F,R,V)),Ee,fe,St,at=N,Te=H(E.width*ce),Nt=!1,Wt=null,pt=null,$t=null,Rr=null;u!=null&&(Te==0||m!=null)&&(Nt=!0,Wt=u.values(p,y,_,w),pt=new Map,new Set(Wt).forEach(D=>{D!=null&&pt.set(D,new Path2D)}),Te>0&&($t=m.values(p,y,_,w),Rr=new Map,new Set($t).forEach(D=>{D!=null&&Rr.set(D,new Path2D)})));let{x0:Pr,size:us}=c;if(Pr!=null&&us!=null){z=1,x=Pr.values(p,y,_,w),Pr.unit==2&&(x=x.map(Ne=>p.posToVal(U+Ne*N,S.key,!0)));let D=us.values(p,y,_,w);us.unit==2?fe=D[0]*N:fe=L(D[0],S,N,U)-L(0,S,N,U),at=ml(x,M,L,S,N,U,at),St=at-fe+j}else at=ml(x,M,L,S,N,U,at),St=at*o+j,fe=at-St;St<1&&(St=0),Te>=fe/2&&(Te=0),St<5&&(H=xl);let Ds=St>0,cr=at-St-(Ds?Te:0);fe=H(jn(cr,Z,W)),Ee=(z==0?fe/2:z==xe?0:fe)-z*xe*((z==0?j/2:0)+(Ds?Te/2:0));let Ke={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Lr=Nt?null:new Path2D,Ht=null;if(te!=null)Ht=p.data[te.series[1]];else{let{y0:D,y1:ve}=c;D!=null&&ve!=null&&(M=ve.values(p,y,_,w),Ht=D.values(p,y,_,w))}let fr=X*fe,ee=tt*fe;for(let D=xe==1?_:w;D>=_&&D<=w;D+=xe){let ve=M[D];if(ve==null)continue;if(Ht!=null){let rt=Ht[D]??0;if(ve-rt==0)continue;je=C(rt,F,R,V)}let Ne=S.distr!=2||c!=null?x[D]:D,Ir=L(Ne,S,N,U),ur=C(oe(ve,Ce),F,R,V),Ot=H(Ir-Ee),hr=H(et(ur,je)),lt=H(kt(ur,je)),gt=hr-lt;if(ve!=null){let rt=ve<0?ee:fr,Mt=ve<0?fr:ee;Nt?(Te>0&&$t[D]!=null&&ie(Rr.get($t[D]),Ot,lt+mt(Te/2),fe,et(0,gt-Te),rt,Mt),Wt[D]!=null&&ie(pt.get(Wt[D]),Ot,lt+mt(Te/2),fe,et(0,gt-Te),rt,Mt)):ie(Lr,Ot,lt+mt(Te/2),fe,et(0,gt-Te),rt,Mt),he(p,y,D,Ot-Te/2,lt,fe+Te,gt)}}return Te>0?Ke.stroke=Nt?Rr:Lr:Nt||(Ke._fill=E.width==0?E._fill:E._stroke??E._fill,Ke.width=0),Ke.fill=Nt?pt:Lr,Ke})}function nd(s,e){let t=oe(e?.alignGaps,0);return(r,i,n,o)=>Sr(r,i,(a,l,c,h,u,m,p,y,_,w,E)=>{[n,o]=oi(c,n,o);let x=a.pxRound,M=X=>x(m(X,h,w,y)),S=X=>x(p(X,u,E,_)),F,L,C;h.ori==0?(F=ui,C=os,L=Kl):(F=hi,C=as,L=$l);let U=h.dir*(h.ori==0?1:-1),V=M(l[U==1?n:o]),N=V,R=[],H=[];for(let X=U==1?n:o;X>=n&&X<=o;X+=U)if(c[X]!=null){let xe=l[X],ie=M(xe);R.push(N=ie),H.push(S(c[X]))}let z={stroke:s(R,H,F,C,L,x),fill:null,clip:null,band:null,gaps:null,flags:is},j=z.stroke,[W,Z]=uo(r,i);if(a.fill!=null||W!=0){let X=z.fill=new Path2D(j),tt=a.fillTo(r,i,a.min,a.max,W),xe=S(tt);C(X,N,xe),C(X,V,xe)}if(!a.spanGaps){let X=[];X.push(...ho(l,c,n,o,U,M,t)),z.gaps=X=a.gaps(r,i,n,o,X),z.clip=fi(X,h.ori,y,_,w,E)}return Z!=0&&(z.band=Z==2?[Xt(r,i,n,o,j,-1),Xt(r,i,n,o,j,1)]:Xt(r,i,n,o,j,Z)),z})}function od(s){return nd(ad,s)}function ad(s,e,t,r,i,n){let o=s.length;if(o<2)return null;let a=new Path2D;if(t(a,s[0],e[0]),o==2)r(a,s[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let m=0;m<o-1;m++)h[m]=e[m+1]-e[m],u[m]=s[m+1]-s[m],c[m]=h[m]/u[m];l[0]=c[0];for(let m=1;m<o-1;m++)c[m]===0||c[m-1]===0||c[m-1]>0!=c[m]>0?l[m]=0:(l[m]=3*(u[m-1]+u[m])/((2*u[m]+u[m-1])/c[m-1]+(u[m]+2*u[m-1])/c[m]),isFinite(l[m])||(l[m]=0));l[o-1]=c[o-2];for(let m=0;m<o-1;m++)i(a,s[m]+u[m]/3,e[m]+l[m]*u[m]/3,s[m+1]-u[m]/3,e[m+1]-l[m+1]*u[m]/3,s[m+1],e[m+1])}return a}var Jn=new Set;function dl(){for(let s of Jn)s.syncRect(!0)}ns&&(Er(zh,es,dl),Er(Gh,es,dl,!0),Er(si,es,()=>{He.pxRatio=ce}));var ld=Zl(),cd=Ql();function pl(s,e,t,r){return(r?[s[0],s[1]].concat(s.slice(2)):[s[0]].concat(s.slice(1))).map((n,o)=>Zn(n,o,e,t))}function fd(s,e){return s.map((t,r)=>r==0?{}:Fe({},e,t))}function Zn(s,e,t,r){return Fe({},e==0?t:r,s)}function ec(s,e,t){return e==null?rs:[e,t]}var ud=ec;function hd(s,e,t){return e==null?rs:ii(e,t,io,!0)}function tc(s,e,t,r){return e==null?rs:ai(e,t,s.scales[r].log,!1)}var md=tc;function rc(s,e,t,r){return e==null?rs:so(e,t,s.scales[r].log,!1)}var dd=rc;function pd(s,e,t,r,i){let n=et(Xa(s),Xa(e)),o=e-s,a=It(i/r*o,t);do{let l=t[a],c=r*l/o;if(c>=i&&n+(l<5?nr.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function gl(s){let e,t;return s=s.replace(/(\d+)px/,(r,i)=>(e=Oe((t=+i)*ce))+"px"),[s,e,t]}function gd(s){s.show&&[s.font,s.labelFont].forEach(e=>{let t=ge(e[2]*ce,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function He(s,e,t){let r={mode:oe(s.mode,1)},i=r.mode;function n(f,d,g,v){let b=d.valToPct(f);return v+g*(d.dir==-1?1-b:b)}function o(f,d,g,v){let b=d.valToPct(f);return v+g*(d.dir==-1?b:1-b)}function a(f,d,g,v){return d.ori==0?n(f,d,g,v):o(f,d,g,v)}r.valToPosH=n,r.valToPosV=o;let l=!1;r.status=0;let c=r.root=Et(Eh);if(s.id!=null&&(c.id=s.id),ht(c,s.class),s.title){let f=Et(Mh,c);f.textContent=s.title}let h=Lt("canvas"),u=r.ctx=h.getContext("2d"),m=Et(Th,c);Er("click",m,f=>{f.target===y&&(ye!=Gr||Ae!=Wr)&&qe.click(r,f)},!0);let p=r.under=Et(Rh,m);m.appendChild(h);let y=r.over=Et(Ph,m);s=ss(s);let _=+oe(s.pxAlign,1),w=hl(_);(s.plugins||[]).forEach(f=>{f.opts&&(s=f.opts(r,s)||s)});let E=s.ms||.001,x=r.series=i==1?pl(s.series||[],nl,fl,!1):fd(s.series||[null],cl),M=r.axes=pl(s.axes||[],il,al,!0),S=r.scales={},F=r.bands=s.bands||[];F.forEach(f=>{f.fill=se(f.fill||null),f.dir=oe(f.dir,-1)});let L=i==2?x[1].facets[0].scale:x[0].scale,C={axes:$u,series:Yu},U=(s.drawOrder||["axes","series"]).map(f=>C[f]);function V(f){let d=f.distr==3?g=>qt(g>0?g:f.clamp(r,g,f.min,f.max,f.key)):f.distr==4?g=>Bn(g,f.asinh):f.distr==100?g=>f.fwd(g):g=>g;return g=>{let v=d(g),{_min:b,_max:A}=f,T=A-b;return(v-b)/T}}function N(f){let d=S[f];if(d==null){let g=(s.scales||Ms)[f]||Ms;if(g.from!=null){N(g.from);let v=Fe({},S[g.from],g,{key:f});v.valToPct=V(v),S[f]=v}else{d=S[f]=Fe({},f==L?Hl:Jm,g),d.key=f;let v=d.time,b=d.range,A=ir(b);if((f!=L||i==2&&!v)&&(A&&(b[0]==null||b[1]==null)&&(b={min:b[0]==null?Ha:{mode:1,hard:b[0],soft:b[0]},max:b[1]==null?Ha:{mode:1,hard:b[1],soft:b[1]}},A=!1),!A&&ci(b))){let T=b;b=(P,I,k)=>I==null?rs:ii(I,k,T)}d.range=se(b||(v?ud:f==L?d.distr==3?md:d.distr==4?dd:ec:d.distr==3?tc:d.distr==4?rc:hd)),d.auto=se(A?!1:d.auto),d.clamp=se(d.clamp||Qm),d._min=d._max=null,d.valToPct=V(d)}}}N("x"),N("y"),i==1&&x.forEach(f=>{N(f.scale)}),M.forEach(f=>{N(f.scale)});for(let f in s.scales)N(f);let R=S[L],H=R.distr,z,j;R.ori==0?(ht(c,Ah),z=n,j=o):(ht(c,Sh),z=o,j=n);let W={};for(let f in S){let d=S[f];(d.min!=null||d.max!=null)&&(W[f]={min:d.min,max:d.max},d.min=d.max=null)}let Z=s.tzDate||(f=>new Date(Oe(f/E))),X=s.fmtDate||ao,tt=E==1?Am(Z):Tm(Z),xe=tl(Z,el(E==1?Em:Mm,X)),ie=sl(Z,rl(Pm,X)),he=[],te=r.legend=Fe({},km,s.legend),Y=r.cursor=Fe({},Um,{drag:{y:i==2}},s.cursor),Ce=te.show,je=Y.show,Ee=te.markers;te.idxs=he,Ee.width=se(Ee.width),Ee.dash=se(Ee.dash),Ee.stroke=se(Ee.stroke),Ee.fill=se(Ee.fill);let fe,St,at,Te=[],Nt=[],Wt,pt=!1,$t={};if(te.live){let f=x[1]?x[1].values:null;pt=f!=null,Wt=pt?f(r,1,0):{_:0};for(let d in Wt)$t[d]=to}if(Ce)if(fe=Lt("table",Nh,c),at=Lt("tbody",null,fe),te.mount(r,fe),pt){St=Lt("thead",null,fe,at);let f=Lt("tr",null,St);Lt("th",null,f);for(var Rr in Wt)Lt("th",Ia,f).textContent=Rr}else ht(fe,Dh),te.live&&ht(fe,Oh);let Pr={show:!0},us={show:!1};function Ds(f,d){if(d==0&&(pt||!te.live||i==2))return rs;let g=[],v=Lt("tr",Uh,at,at.childNodes[d]);ht(v,f.class),f.show||ht(v,xr);let b=Lt("th",null,v);if(Ee.show){let P=Et(Vh,b);if(d>0){let I=Ee.width(r,d);I&&(P.style.border=I+"px "+Ee.dash(r,d)+" "+Ee.stroke(r,d)),P.style.background=Ee.fill(r,d)}}let A=Et(Ia,b);f.label instanceof HTMLElement?A.appendChild(f.label):A.textContent=f.label,d>0&&(Ee.show||(A.style.color=f.width>0?Ee.stroke(r,d):Ee.fill(r,d)),Ke("click",b,P=>{if(Y._lock)return;dr(P);let I=x.indexOf(f);if((P.ctrlKey||P.metaKey)!=te.isolate){let k=x.some((O,B)=>B>0&&B!=I&&O.show);x.forEach((O,B)=>{B>0&&Ut(B,k?B==I?Pr:us:Pr,!0,ke.setSeries)})}else Ut(I,{show:!f.show},!0,ke.setSeries)},!1),Fr&&Ke(Na,b,P=>{Y._lock||(dr(P),Ut(x.indexOf(f),Yr,!0,ke.setSeries))},!1));for(var T in Wt){let P=Lt("td",Bh,v);P.textContent="--",g.push(P)}return[v,g]}let cr=new Map;function Ke(f,d,g,v=!0){let b=cr.get(d)||{},A=Y.bind[f](r,d,g,v);A&&(Er(f,d,b[f]=A),cr.set(d,b))}function Lr(f,d,g){let v=cr.get(d)||{};for(let b in v)(f==null||b==f)&&(Xn(b,d,v[b]),delete v[b]);f==null&&cr.delete(d)}let Ht=0,fr=0,ee=0,D=0,ve=0,Ne=0,Ir=ve,ur=Ne,Ot=ee,hr=D,lt=0,gt=0,rt=0,Mt=0;r.bbox={};let on=!1,Us=!1,kr=!1,mr=!1,Vs=!1,vt=!1;function an(f,d,g){(g||f!=r.width||d!=r.height)&&zo(f,d),Ur(!1),kr=!0,Us=!0,Vr()}function zo(f,d){r.width=Ht=ee=f,r.height=fr=D=d,ve=Ne=0,Uu(),Vu();let g=r.bbox;lt=g.left=br(ve*ce,.5),gt=g.top=br(Ne*ce,.5),rt=g.width=br(ee*ce,.5),Mt=g.height=br(D*ce,.5)}let Nu=3;function Ou(){let f=!1,d=0;for(;!f;){d++;let g=ju(d),v=Ku(d);f=d==Nu||g&&v,f||(zo(r.width,r.height),Us=!0)}}function Du({width:f,height:d}){an(f,d)}r.setSize=Du;function Uu(){let f=!1,d=!1,g=!1,v=!1;M.forEach((b,A)=>{if(b.show&&b._show){let{side:T,_size:P}=b,I=T%2,k=b.label!=null?b.labelSize:0,O=P+k;O>0&&(I?(ee-=O,T==3?(ve+=O,v=!0):g=!0):(D-=O,T==0?(Ne+=O,f=!0):d=!0))}}),pr[0]=f,pr[1]=g,pr[2]=d,pr[3]=v,ee-=Qt[1]+Qt[3],ve+=Qt[3],D-=Qt[2]+Qt[0],Ne+=Qt[0]}function Vu(){let f=ve+ee,d=Ne+D,g=ve,v=Ne;function b(A,T){switch(A){case 1:return f+=T,f-T;case 2:return d+=T,d-T;case 3:return g-=T,g+T;case 0:return v-=T,v+T}}M.forEach((A,T)=>{if(A.show&&A._show){let P=A.side;A._pos=b(P,A._size),A.label!=null&&(A._lpos=b(P,A.labelSize))}})}if(Y.dataIdx==null){let f=Y.hover,d=f.skip=new Set(f.skip??[]);d.add(void 0);let g=f.prox=se(f.prox),v=f.bias??=0;Y.dataIdx=(b,A,T,P)=>{if(A==0)return T;let I=T,k=g(b,A,T,P)??pe,O=k>=0&&k<pe,B=R.ori==0?ee:D,Q=Y.left,ae=e[0],ne=e[A];if(d.has(ne[T])){I=null;let re=null,$=null,q;if(v==0||v==-1)for(q=T;re==null&&q-- >0;)d.has(ne[q])||(re=q);if(v==0||v==1)for(q=T;$==null&&q++<ne.length;)d.has(ne[q])||($=q);if(re!=null||$!=null)if(O){let be=re==null?-1/0:z(ae[re],R,B,0),Pe=$==null?1/0:z(ae[$],R,B,0),We=Q-be,me=Pe-Q;We<=me?We<=k&&(I=re):me<=k&&(I=$)}else I=$==null?re:re==null?$:T-re<=$-T?re:$}else O&&De(Q-z(ae[T],R,B,0))>k&&(I=null);return I}}let dr=f=>{Y.event=f};Y.idxs=he,Y._lock=!1;let Xe=Y.points;Xe.show=se(Xe.show),Xe.size=se(Xe.size),Xe.stroke=se(Xe.stroke),Xe.width=se(Xe.width),Xe.fill=se(Xe.fill);let Dt=r.focus=Fe({},s.focus||{alpha:.3},Y.focus),Fr=Dt.prox>=0,Cr=Fr&&Xe.one,yt=[],Nr=[],Or=[];function Go(f,d){let g=Xe.show(r,d);if(g instanceof HTMLElement)return ht(g,Ch),ht(g,f.class),Gt(g,-10,-10,ee,D),y.insertBefore(g,yt[d]),g}function Wo(f,d){if(i==1||d>0){let g=i==1&&S[f.scale].time,v=f.value;f.value=g?$a(v)?sl(Z,rl(v,X)):v||ie:v||jm,f.label=f.label||(g?Bm:Vm)}if(Cr||d>0){f.width=f.width==null?1:f.width,f.paths=f.paths||ld||Jh,f.fillTo=se(f.fillTo||Zm),f.pxAlign=+oe(f.pxAlign,_),f.pxRound=hl(f.pxAlign),f.stroke=se(f.stroke||null),f.fill=se(f.fill||null),f._stroke=f._fill=f._paths=f._focus=null;let g=Km(et(1,f.width),1),v=f.points=Fe({},{size:g,width:et(1,g*.2),stroke:f.stroke,space:g*2,paths:cd,_stroke:null,_fill:null},f.points);v.show=se(v.show),v.filter=se(v.filter),v.fill=se(v.fill),v.stroke=se(v.stroke),v.paths=se(v.paths),v.pxAlign=f.pxAlign}if(Ce){let g=Ds(f,d);Te.splice(d,0,g[0]),Nt.splice(d,0,g[1]),te.values.push(null)}if(je){he.splice(d,0,null);let g=null;Cr?d==0&&(g=Go(f,d)):d>0&&(g=Go(f,d)),yt.splice(d,0,g),Nr.splice(d,0,0),Or.splice(d,0,0)}Ge("addSeries",d)}function Bu(f,d){d=d??x.length,f=i==1?Zn(f,d,nl,fl):Zn(f,d,{},cl),x.splice(d,0,f),Wo(x[d],d)}r.addSeries=Bu;function zu(f){if(x.splice(f,1),Ce){te.values.splice(f,1),Nt.splice(f,1);let d=Te.splice(f,1)[0];Lr(null,d.firstChild),d.remove()}je&&(he.splice(f,1),yt.splice(f,1)[0].remove(),Nr.splice(f,1),Or.splice(f,1)),Ge("delSeries",f)}r.delSeries=zu;let pr=[!1,!1,!1,!1];function Gu(f,d){if(f._show=f.show,f.show){let g=f.side%2,v=S[f.scale];v==null&&(f.scale=g?x[1].scale:L,v=S[f.scale]);let b=v.time;f.size=se(f.size),f.space=se(f.space),f.rotate=se(f.rotate),ir(f.incrs)&&f.incrs.forEach(T=>{!nr.has(T)&&nr.set(T,Sl(T))}),f.incrs=se(f.incrs||(v.distr==2?bm:b?E==1?xm:Sm:wr)),f.splits=se(f.splits||(b&&v.distr==1?tt:v.distr==3?Kn:v.distr==4?Wm:Gm)),f.stroke=se(f.stroke),f.grid.stroke=se(f.grid.stroke),f.ticks.stroke=se(f.ticks.stroke),f.border.stroke=se(f.border.stroke);let A=f.values;f.values=ir(A)&&!ir(A[0])?se(A):b?ir(A)?tl(Z,el(A,X)):$a(A)?Rm(Z,A):A||xe:A||zm,f.filter=se(f.filter||(v.distr>=3&&v.log==10?qm:v.distr==3&&v.log==2?Xm:El)),f.font=gl(f.font),f.labelFont=gl(f.labelFont),f._size=f.size(r,null,d,0),f._space=f._rotate=f._incrs=f._found=f._splits=f._values=null,f._size>0&&(pr[d]=!0,f._el=Et(Lh,m))}}function hs(f,d,g,v){let[b,A,T,P]=g,I=d%2,k=0;return I==0&&(P||A)&&(k=d==0&&!b||d==2&&!T?Oe(il.size/3):0),I==1&&(b||T)&&(k=d==1&&!A||d==3&&!P?Oe(al.size/2):0),k}let Ho=r.padding=(s.padding||[hs,hs,hs,hs]).map(f=>se(oe(f,hs))),Qt=r._padding=Ho.map((f,d)=>f(r,d,pr,0)),Ye,Ue=null,Ve=null,Bs=i==1?x[0].idxs:null,Tt=null,ms=!1;function Yo(f,d){if(e=f??[],r.data=r._data=e,i==2){Ye=0;for(let g=1;g<x.length;g++)Ye+=e[g][0].length}else{e.length==0&&(r.data=r._data=e=[[]]),Tt=e[0],Ye=Tt.length;let g=e;if(H==2){g=e.slice();let v=g[0]=Array(Ye);for(let b=0;b<Ye;b++)v[b]=b}r._data=e=g}if(Ur(!0),Ge("setData"),H==2&&(kr=!0),d!==!1){let g=R;g.auto(r,ms)?ln():Zt(L,g.min,g.max),mr=mr||Y.left>=0,vt=!0,Vr()}}r.setData=Yo;function ln(){ms=!0;let f,d;i==1&&(Ye>0?(Ue=Bs[0]=0,Ve=Bs[1]=Ye-1,f=e[0][Ue],d=e[0][Ve],H==2?(f=Ue,d=Ve):f==d&&(H==3?[f,d]=ai(f,f,R.log,!1):H==4?[f,d]=so(f,f,R.log,!1):R.time?d=f+Oe(86400/E):[f,d]=ii(f,d,io,!0))):(Ue=Bs[0]=f=null,Ve=Bs[1]=d=null)),Zt(L,f,d)}let zs,Dr,cn,fn,un,hn,mn,dn,pn,st;function qo(f,d,g,v,b,A){f??=Fa,g??=oo,v??="butt",b??=Fa,A??="round",f!=zs&&(u.strokeStyle=zs=f),b!=Dr&&(u.fillStyle=Dr=b),d!=cn&&(u.lineWidth=cn=d),A!=un&&(u.lineJoin=un=A),v!=hn&&(u.lineCap=hn=v),g!=fn&&u.setLineDash(fn=g)}function Xo(f,d,g,v){d!=Dr&&(u.fillStyle=Dr=d),f!=mn&&(u.font=mn=f),g!=dn&&(u.textAlign=dn=g),v!=pn&&(u.textBaseline=pn=v)}function gn(f,d,g,v,b=0){if(v.length>0&&f.auto(r,ms)&&(d==null||d.min==null)){let A=oe(Ue,0),T=oe(Ve,v.length-1),P=g.min==null?qh(v,A,T,b,f.distr==3):[g.min,g.max];f.min=kt(f.min,g.min=P[0]),f.max=et(f.max,g.max=P[1])}}let jo={min:null,max:null};function Wu(){for(let v in S){let b=S[v];W[v]==null&&(b.min==null||W[L]!=null&&b.auto(r,ms))&&(W[v]=jo)}for(let v in S){let b=S[v];W[v]==null&&b.from!=null&&W[b.from]!=null&&(W[v]=jo)}W[L]!=null&&Ur(!0);let f={};for(let v in W){let b=W[v];if(b!=null){let A=f[v]=ss(S[v],tm);if(b.min!=null)Fe(A,b);else if(v!=L||i==2)if(Ye==0&&A.from==null){let T=A.range(r,null,null,v);A.min=T[0],A.max=T[1]}else A.min=pe,A.max=-pe}}if(Ye>0){x.forEach((v,b)=>{if(i==1){let A=v.scale,T=W[A];if(T==null)return;let P=f[A];if(b==0){let I=P.range(r,P.min,P.max,A);P.min=I[0],P.max=I[1],Ue=It(P.min,e[0]),Ve=It(P.max,e[0]),Ve-Ue>1&&(e[0][Ue]<P.min&&Ue++,e[0][Ve]>P.max&&Ve--),v.min=Tt[Ue],v.max=Tt[Ve]}else v.show&&v.auto&&gn(P,T,v,e[b],v.sorted);v.idxs[0]=Ue,v.idxs[1]=Ve}else if(b>0&&v.show&&v.auto){let[A,T]=v.facets,P=A.scale,I=T.scale,[k,O]=e[b],B=f[P],Q=f[I];B!=null&&gn(B,W[P],A,k,A.sorted),Q!=null&&gn(Q,W[I],T,O,T.sorted),v.min=T.min,v.max=T.max}});for(let v in f){let b=f[v],A=W[v];if(b.from==null&&(A==null||A.min==null)){let T=b.range(r,b.min==pe?null:b.min,b.max==-pe?null:b.max,v);b.min=T[0],b.max=T[1]}}}for(let v in f){let b=f[v];if(b.from!=null){let A=f[b.from];if(A.min==null)b.min=b.max=null;else{let T=b.range(r,A.min,A.max,v);b.min=T[0],b.max=T[1]}}}let d={},g=!1;for(let v in f){let b=f[v],A=S[v];if(A.min!=b.min||A.max!=b.max){A.min=b.min,A.max=b.max;let T=A.distr;A._min=T==3?qt(A.min):T==4?Bn(A.min,A.asinh):T==100?A.fwd(A.min):A.min,A._max=T==3?qt(A.max):T==4?Bn(A.max,A.asinh):T==100?A.fwd(A.max):A.max,d[v]=g=!0}}if(g){x.forEach((v,b)=>{i==2?b>0&&d.y&&(v._paths=null):d[v.scale]&&(v._paths=null)});for(let v in d)kr=!0,Ge("setScale",v);je&&Y.left>=0&&(mr=vt=!0)}for(let v in W)W[v]=null}function Hu(f){let d=jn(Ue-1,0,Ye-1),g=jn(Ve+1,0,Ye-1);for(;f[d]==null&&d>0;)d--;for(;f[g]==null&&g<Ye-1;)g++;return[d,g]}function Yu(){if(Ye>0){let f=x.some(d=>d._focus)&&st!=Dt.alpha;f&&(u.globalAlpha=st=Dt.alpha),x.forEach((d,g)=>{if(g>0&&d.show&&(Ko(g,!1),Ko(g,!0),d._paths==null)){let v=st;st!=d.alpha&&(u.globalAlpha=st=d.alpha);let b=i==2?[0,e[g][0].length-1]:Hu(e[g]);d._paths=d.paths(r,g,b[0],b[1]),st!=v&&(u.globalAlpha=st=v)}}),x.forEach((d,g)=>{if(g>0&&d.show){let v=st;st!=d.alpha&&(u.globalAlpha=st=d.alpha),d._paths!=null&&$o(g,!1);{let b=d._paths!=null?d._paths.gaps:null,A=d.points.show(r,g,Ue,Ve,b),T=d.points.filter(r,g,A,b);(A||T)&&(d.points._paths=d.points.paths(r,g,Ue,Ve,T),$o(g,!0))}st!=v&&(u.globalAlpha=st=v),Ge("drawSeries",g)}}),f&&(u.globalAlpha=st=1)}}function Ko(f,d){let g=d?x[f].points:x[f];g._stroke=g.stroke(r,f),g._fill=g.fill(r,f)}function $o(f,d){let g=d?x[f].points:x[f],{stroke:v,fill:b,clip:A,flags:T,_stroke:P=g._stroke,_fill:I=g._fill,_width:k=g.width}=g._paths;k=ge(k*ce,3);let O=null,B=k%2/2;d&&I==null&&(I=k>0?"#fff":P);let Q=g.pxAlign==1&&B>0;if(Q&&u.translate(B,B),!d){let ae=lt-k/2,ne=gt-k/2,re=rt+k,$=Mt+k;O=new Path2D,O.rect(ae,ne,re,$)}d?vn(P,k,g.dash,g.cap,I,v,b,T,A):qu(f,P,k,g.dash,g.cap,I,v,b,T,O,A),Q&&u.translate(-B,-B)}function qu(f,d,g,v,b,A,T,P,I,k,O){let B=!1;I!=0&&F.forEach((Q,ae)=>{if(Q.series[0]==f){let ne=x[Q.series[1]],re=e[Q.series[1]],$=(ne._paths||Ms).band;ir($)&&($=Q.dir==1?$[0]:$[1]);let q,be=null;ne.show&&$&&jh(re,Ue,Ve)?(be=Q.fill(r,ae)||A,q=ne._paths.clip):$=null,vn(d,g,v,b,be,T,P,I,k,O,q,$),B=!0}}),B||vn(d,g,v,b,A,T,P,I,k,O)}let Qo=is|Qn;function vn(f,d,g,v,b,A,T,P,I,k,O,B){qo(f,d,g,v,b),(I||k||B)&&(u.save(),I&&u.clip(I),k&&u.clip(k)),B?(P&Qo)==Qo?(u.clip(B),O&&u.clip(O),Ws(b,T),Gs(f,A,d)):P&Qn?(Ws(b,T),u.clip(B),Gs(f,A,d)):P&is&&(u.save(),u.clip(B),O&&u.clip(O),Ws(b,T),u.restore(),Gs(f,A,d)):(Ws(b,T),Gs(f,A,d)),(I||k||B)&&u.restore()}function Gs(f,d,g){g>0&&(d instanceof Map?d.forEach((v,b)=>{u.strokeStyle=zs=b,u.stroke(v)}):d!=null&&f&&u.stroke(d))}function Ws(f,d){d instanceof Map?d.forEach((g,v)=>{u.fillStyle=Dr=v,u.fill(g)}):d!=null&&f&&u.fill(d)}function Xu(f,d,g,v){let b=M[f],A;if(v<=0)A=[0,0];else{let T=b._space=b.space(r,f,d,g,v),P=b._incrs=b.incrs(r,f,d,g,v,T);A=pd(d,g,P,v,T)}return b._found=A}function yn(f,d,g,v,b,A,T,P,I,k){let O=T%2/2;_==1&&u.translate(O,O),qo(P,T,I,k,P),u.beginPath();let B,Q,ae,ne,re=b+(v==0||v==3?-A:A);g==0?(Q=b,ne=re):(B=b,ae=re);for(let $=0;$<f.length;$++)d[$]!=null&&(g==0?B=ae=f[$]:Q=ne=f[$],u.moveTo(B,Q),u.lineTo(ae,ne));u.stroke(),_==1&&u.translate(-O,-O)}function ju(f){let d=!0;return M.forEach((g,v)=>{if(!g.show)return;let b=S[g.scale];if(b.min==null){g._show&&(d=!1,g._show=!1,Ur(!1));return}else g._show||(d=!1,g._show=!0,Ur(!1));let A=g.side,T=A%2,{min:P,max:I}=b,[k,O]=Xu(v,P,I,T==0?ee:D);if(O==0)return;let B=b.distr==2,Q=g._splits=g.splits(r,v,P,I,k,O,B),ae=b.distr==2?Q.map(q=>Tt[q]):Q,ne=b.distr==2?Tt[Q[1]]-Tt[Q[0]]:k,re=g._values=g.values(r,g.filter(r,ae,v,O,ne),v,O,ne);g._rotate=A==2?g.rotate(r,re,v,O):0;let $=g._size;g._size=At(g.size(r,re,v,f)),$!=null&&g._size!=$&&(d=!1)}),d}function Ku(f){let d=!0;return Ho.forEach((g,v)=>{let b=g(r,v,pr,f);b!=Qt[v]&&(d=!1),Qt[v]=b}),d}function $u(){for(let f=0;f<M.length;f++){let d=M[f];if(!d.show||!d._show)continue;let g=d.side,v=g%2,b,A,T=d.stroke(r,f),P=g==0||g==3?-1:1,[I,k]=d._found;if(d.label!=null){let Qe=d.labelGap*P,ut=Oe((d._lpos+Qe)*ce);Xo(d.labelFont[0],T,"center",g==2?"top":ka),u.save(),v==1?(b=A=0,u.translate(ut,Oe(gt+Mt/2)),u.rotate((g==3?-ri:ri)/2)):(b=Oe(lt+rt/2),A=ut);let yr=wl(d.label)?d.label(r,f,I,k):d.label;u.fillText(yr,b,A),u.restore()}if(k==0)continue;let O=S[d.scale],B=v==0?rt:Mt,Q=v==0?lt:gt,ae=d._splits,ne=O.distr==2?ae.map(Qe=>Tt[Qe]):ae,re=O.distr==2?Tt[ae[1]]-Tt[ae[0]]:I,$=d.ticks,q=d.border,be=$.show?$.size:0,Pe=Oe(be*ce),We=Oe((d.alignTo==2?d._size-be-d.gap:d.gap)*ce),me=d._rotate*-ri/180,Le=w(d._pos*ce),ct=(Pe+We)*P,$e=Le+ct;A=v==0?$e:0,b=v==1?$e:0;let _t=d.font[0],Rt=d.align==1?Jr:d.align==2?Dn:me>0?Jr:me<0?Dn:v==0?"center":g==3?Dn:Jr,Bt=me||v==1?"middle":g==2?"top":ka;Xo(_t,T,Rt,Bt);let ft=d.font[1]*d.lineGap,bt=ae.map(Qe=>w(a(Qe,O,B,Q))),Pt=d._values;for(let Qe=0;Qe<Pt.length;Qe++){let ut=Pt[Qe];if(ut!=null){v==0?b=bt[Qe]:A=bt[Qe],ut=""+ut;let yr=ut.indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let Je=0;Je<yr.length;Je++){let ga=yr[Je];me?(u.save(),u.translate(b,A+Je*ft),u.rotate(me),u.fillText(ga,0,0),u.restore()):u.fillText(ga,b,A+Je*ft)}}}$.show&&yn(bt,$.filter(r,ne,f,k,re),v,g,Le,Pe,ge($.width*ce,3),$.stroke(r,f),$.dash,$.cap);let zt=d.grid;zt.show&&yn(bt,zt.filter(r,ne,f,k,re),v,v==0?2:1,v==0?gt:lt,v==0?Mt:rt,ge(zt.width*ce,3),zt.stroke(r,f),zt.dash,zt.cap),q.show&&yn([Le],[1],v==0?1:0,v==0?1:2,v==1?gt:lt,v==1?Mt:rt,ge(q.width*ce,3),q.stroke(r,f),q.dash,q.cap)}Ge("drawAxes")}function Ur(f){x.forEach((d,g)=>{g>0&&(d._paths=null,f&&(i==1?(d.min=null,d.max=null):d.facets.forEach(v=>{v.min=null,v.max=null})))})}let Hs=!1,_n=!1,ds=[];function Qu(){_n=!1;for(let f=0;f<ds.length;f++)Ge(...ds[f]);ds.length=0}function Vr(){Hs||(lm(Jo),Hs=!0)}function Ju(f,d=!1){Hs=!0,_n=d,f(r),Jo(),d&&ds.length>0&&queueMicrotask(Qu)}r.batch=Ju;function Jo(){if(on&&(Wu(),on=!1),kr&&(Ou(),kr=!1),Us){if(we(p,Jr,ve),we(p,"top",Ne),we(p,xs,ee),we(p,Es,D),we(y,Jr,ve),we(y,"top",Ne),we(y,xs,ee),we(y,Es,D),we(m,xs,Ht),we(m,Es,fr),h.width=Oe(Ht*ce),h.height=Oe(fr*ce),M.forEach(({_el:f,_show:d,_size:g,_pos:v,side:b})=>{if(f!=null)if(d){let A=b===3||b===0?g:0,T=b%2==1;we(f,T?"left":"top",v-A),we(f,T?"width":"height",g),we(f,T?"top":"left",T?Ne:ve),we(f,T?"height":"width",T?D:ee),qn(f,xr)}else ht(f,xr)}),zs=Dr=cn=un=hn=mn=dn=pn=fn=null,st=1,vs(!0),ve!=Ir||Ne!=ur||ee!=Ot||D!=hr){Ur(!1);let f=ee/Ot,d=D/hr;if(je&&!mr&&Y.left>=0){Y.left*=f,Y.top*=d,Br&&Gt(Br,Oe(Y.left),0,ee,D),zr&&Gt(zr,0,Oe(Y.top),ee,D);for(let g=0;g<yt.length;g++){let v=yt[g];v!=null&&(Nr[g]*=f,Or[g]*=d,Gt(v,At(Nr[g]),At(Or[g]),ee,D))}}if(_e.show&&!Vs&&_e.left>=0&&_e.width>0){_e.left*=f,_e.width*=f,_e.top*=d,_e.height*=d;for(let g in Sn)we(Hr,g,_e[g])}Ir=ve,ur=Ne,Ot=ee,hr=D}Ge("setSize"),Us=!1}Ht>0&&fr>0&&(u.clearRect(0,0,h.width,h.height),Ge("drawClear"),U.forEach(f=>f()),Ge("draw")),_e.show&&Vs&&(Ys(_e),Vs=!1),je&&mr&&(vr(null,!0,!1),mr=!1),te.show&&te.live&&vt&&(En(),vt=!1),l||(l=!0,r.status=1,Ge("ready")),ms=!1,Hs=!1}r.redraw=(f,d)=>{kr=d||!1,f!==!1?Zt(L,R.min,R.max):Vr()};function bn(f,d){let g=S[f];if(g.from==null){if(Ye==0){let v=g.range(r,d.min,d.max,f);d.min=v[0],d.max=v[1]}if(d.min>d.max){let v=d.min;d.min=d.max,d.max=v}if(Ye>1&&d.min!=null&&d.max!=null&&d.max-d.min<1e-16)return;f==L&&g.distr==2&&Ye>0&&(d.min=It(d.min,e[0]),d.max=It(d.max,e[0]),d.min==d.max&&d.max++),W[f]=d,on=!0,Vr()}}r.setScale=bn;let wn,xn,Br,zr,Zo,ea,Gr,Wr,ta,ra,ye,Ae,Jt=!1,qe=Y.drag,Be=qe.x,ze=qe.y;je&&(Y.x&&(wn=Et(kh,y)),Y.y&&(xn=Et(Fh,y)),R.ori==0?(Br=wn,zr=xn):(Br=xn,zr=wn),ye=Y.left,Ae=Y.top);let _e=r.select=Fe({show:!0,over:!0,left:0,width:0,top:0,height:0},s.select),Hr=_e.show?Et(Ih,_e.over?y:p):null;function Ys(f,d){if(_e.show){for(let g in f)_e[g]=f[g],g in Sn&&we(Hr,g,f[g]);d!==!1&&Ge("setSelect")}}r.setSelect=Ys;function Zu(f){if(x[f].show)Ce&&qn(Te[f],xr);else if(Ce&&ht(Te[f],xr),je){let g=Cr?yt[0]:yt[f];g!=null&&Gt(g,-10,-10,ee,D)}}function Zt(f,d,g){bn(f,{min:d,max:g})}function Ut(f,d,g,v){d.focus!=null&&ih(f),d.show!=null&&x.forEach((b,A)=>{A>0&&(f==A||f==null)&&(b.show=d.show,Zu(A),i==2?(Zt(b.facets[0].scale,null,null),Zt(b.facets[1].scale,null,null)):Zt(b.scale,null,null),Vr())}),g!==!1&&Ge("setSeries",f,d),v&&ys("setSeries",r,f,d)}r.setSeries=Ut;function eh(f,d){Fe(F[f],d)}function th(f,d){f.fill=se(f.fill||null),f.dir=oe(f.dir,-1),d=d??F.length,F.splice(d,0,f)}function rh(f){f==null?F.length=0:F.splice(f,1)}r.addBand=th,r.setBand=eh,r.delBand=rh;function sh(f,d){x[f].alpha=d,je&&yt[f]!=null&&(yt[f].style.opacity=d),Ce&&Te[f]&&(Te[f].style.opacity=d)}let Yt,er,gr,Yr={focus:!0};function ih(f){if(f!=gr){let d=f==null,g=Dt.alpha!=1;x.forEach((v,b)=>{if(i==1||b>0){let A=d||b==0||b==f;v._focus=d?null:A,g&&sh(b,A?1:Dt.alpha)}}),gr=f,g&&Vr()}}Ce&&Fr&&Ke(Oa,fe,f=>{Y._lock||(dr(f),gr!=null&&Ut(null,Yr,!0,ke.setSeries))});function Vt(f,d,g){let v=S[d];g&&(f=f/ce-(v.ori==1?Ne:ve));let b=ee;v.ori==1&&(b=D,f=b-f),v.dir==-1&&(f=b-f);let A=v._min,T=v._max,P=f/b,I=A+(T-A)*P,k=v.distr;return k==3?ts(10,I):k==4?$h(I,v.asinh):k==100?v.bwd(I):I}function nh(f,d){let g=Vt(f,L,d);return It(g,e[0],Ue,Ve)}r.valToIdx=f=>It(f,e[0]),r.posToIdx=nh,r.posToVal=Vt,r.valToPos=(f,d,g)=>S[d].ori==0?n(f,S[d],g?rt:ee,g?lt:0):o(f,S[d],g?Mt:D,g?gt:0),r.setCursor=(f,d,g)=>{ye=f.left,Ae=f.top,vr(null,d,g)};function sa(f,d){we(Hr,Jr,_e.left=f),we(Hr,xs,_e.width=d)}function ia(f,d){we(Hr,"top",_e.top=f),we(Hr,Es,_e.height=d)}let ps=R.ori==0?sa:ia,gs=R.ori==1?sa:ia;function oh(){if(Ce&&te.live)for(let f=i==2?1:0;f<x.length;f++){if(f==0&&pt)continue;let d=te.values[f],g=0;for(let v in d)Nt[f][g++].firstChild.nodeValue=d[v]}}function En(f,d){if(f!=null&&(f.idxs?f.idxs.forEach((g,v)=>{he[v]=g}):em(f.idx)||he.fill(f.idx),te.idx=he[0]),Ce&&te.live){for(let g=0;g<x.length;g++)(g>0||i==1&&!pt)&&ah(g,he[g]);oh()}vt=!1,d!==!1&&Ge("setLegend")}r.setLegend=En;function ah(f,d){let g=x[f],v=f==0&&H==2?Tt:e[f],b;pt?b=g.values(r,f,d)??$t:(b=g.value(r,d==null?null:v[d],f,d),b=b==null?$t:{_:b}),te.values[f]=b}function vr(f,d,g){ta=ye,ra=Ae,[ye,Ae]=Y.move(r,ye,Ae),Y.left=ye,Y.top=Ae,je&&(Br&&Gt(Br,Oe(ye),0,ee,D),zr&&Gt(zr,0,Oe(Ae),ee,D));let v,b=Ue>Ve;Yt=pe,er=null;let A=R.ori==0?ee:D,T=R.ori==1?ee:D;if(ye<0||Ye==0||b){v=Y.idx=null;for(let P=0;P<x.length;P++){let I=yt[P];I!=null&&Gt(I,-10,-10,ee,D)}Fr&&Ut(null,Yr,!0,f==null&&ke.setSeries),te.live&&(he.fill(v),vt=!0)}else{let P,I,k;i==1&&(P=R.ori==0?ye:Ae,I=Vt(P,L),v=Y.idx=It(I,e[0],Ue,Ve),k=z(e[0][v],R,A,0));let O=-10,B=-10,Q=0,ae=0,ne=!0,re="",$="";for(let q=i==2?1:0;q<x.length;q++){let be=x[q],Pe=he[q],We=Pe==null?null:i==1?e[q][Pe]:e[q][1][Pe],me=Y.dataIdx(r,q,v,I),Le=me==null?null:i==1?e[q][me]:e[q][1][me];if(vt=vt||Le!=We||me!=Pe,he[q]=me,q>0&&be.show){let ct=me==null?-10:me==v?k:z(i==1?e[0][me]:e[q][0][me],R,A,0),$e=Le==null?-10:j(Le,i==1?S[be.scale]:S[be.facets[1].scale],T,0);if(Fr&&Le!=null){let _t=R.ori==1?ye:Ae,Rt=De(Dt.dist(r,q,me,$e,_t));if(Rt<Yt){let Bt=Dt.bias;if(Bt!=0){let ft=Vt(_t,be.scale),bt=Le>=0?1:-1,Pt=ft>=0?1:-1;Pt==bt&&(Pt==1?Bt==1?Le>=ft:Le<=ft:Bt==1?Le<=ft:Le>=ft)&&(Yt=Rt,er=q)}else Yt=Rt,er=q}}if(vt||Cr){let _t,Rt;R.ori==0?(_t=ct,Rt=$e):(_t=$e,Rt=ct);let Bt,ft,bt,Pt,zt,Qe,ut=!0,yr=Xe.bbox;if(yr!=null){ut=!1;let Je=yr(r,q);bt=Je.left,Pt=Je.top,Bt=Je.width,ft=Je.height}else bt=_t,Pt=Rt,Bt=ft=Xe.size(r,q);if(Qe=Xe.fill(r,q),zt=Xe.stroke(r,q),Cr)q==er&&Yt<=Dt.prox&&(O=bt,B=Pt,Q=Bt,ae=ft,ne=ut,re=Qe,$=zt);else{let Je=yt[q];Je!=null&&(Nr[q]=bt,Or[q]=Pt,Wa(Je,Bt,ft,ut),za(Je,Qe,zt),Gt(Je,At(bt),At(Pt),ee,D))}}}}if(Cr){let q=Dt.prox,be=gr==null?Yt<=q:Yt>q||er!=gr;if(vt||be){let Pe=yt[0];Pe!=null&&(Nr[0]=O,Or[0]=B,Wa(Pe,Q,ae,ne),za(Pe,re,$),Gt(Pe,At(O),At(B),ee,D))}}}if(_e.show&&Jt)if(f!=null){let[P,I]=ke.scales,[k,O]=ke.match,[B,Q]=f.cursor.sync.scales,ae=f.cursor.drag;if(Be=ae._x,ze=ae._y,Be||ze){let{left:ne,top:re,width:$,height:q}=f.select,be=f.scales[B].ori,Pe=f.posToVal,We,me,Le,ct,$e,_t=P!=null&&k(P,B),Rt=I!=null&&O(I,Q);_t&&Be?(be==0?(We=ne,me=$):(We=re,me=q),Le=S[P],ct=z(Pe(We,B),Le,A,0),$e=z(Pe(We+me,B),Le,A,0),ps(kt(ct,$e),De($e-ct))):ps(0,A),Rt&&ze?(be==1?(We=ne,me=$):(We=re,me=q),Le=S[I],ct=j(Pe(We,Q),Le,T,0),$e=j(Pe(We+me,Q),Le,T,0),gs(kt(ct,$e),De($e-ct))):gs(0,T)}else Mn()}else{let P=De(ta-Zo),I=De(ra-ea);if(R.ori==1){let Q=P;P=I,I=Q}Be=qe.x&&P>=qe.dist,ze=qe.y&&I>=qe.dist;let k=qe.uni;k!=null?Be&&ze&&(Be=P>=k,ze=I>=k,!Be&&!ze&&(I>P?ze=!0:Be=!0)):qe.x&&qe.y&&(Be||ze)&&(Be=ze=!0);let O,B;Be&&(R.ori==0?(O=Gr,B=ye):(O=Wr,B=Ae),ps(kt(O,B),De(B-O)),ze||gs(0,T)),ze&&(R.ori==1?(O=Gr,B=ye):(O=Wr,B=Ae),gs(kt(O,B),De(B-O)),Be||ps(0,A)),!Be&&!ze&&(ps(0,0),gs(0,0))}if(qe._x=Be,qe._y=ze,f==null){if(g){if(pa!=null){let[P,I]=ke.scales;ke.values[0]=P!=null?Vt(R.ori==0?ye:Ae,P):null,ke.values[1]=I!=null?Vt(R.ori==1?ye:Ae,I):null}ys(Un,r,ye,Ae,ee,D,v)}if(Fr){let P=g&&ke.setSeries,I=Dt.prox;gr==null?Yt<=I&&Ut(er,Yr,!0,P):Yt>I?Ut(null,Yr,!0,P):er!=gr&&Ut(er,Yr,!0,P)}}vt&&(te.idx=v,En()),d!==!1&&Ge("setCursor")}let tr=null;Object.defineProperty(r,"rect",{get(){return tr==null&&vs(!1),tr}});function vs(f=!1){f?tr=null:(tr=y.getBoundingClientRect(),Ge("syncRect",tr))}function na(f,d,g,v,b,A,T){Y._lock||Jt&&f!=null&&f.movementX==0&&f.movementY==0||(An(f,d,g,v,b,A,T,!1,f!=null),f!=null?vr(null,!0,!0):vr(d,!0,!1))}function An(f,d,g,v,b,A,T,P,I){if(tr==null&&vs(!1),dr(f),f!=null)g=f.clientX-tr.left,v=f.clientY-tr.top;else{if(g<0||v<0){ye=-10,Ae=-10;return}let[k,O]=ke.scales,B=d.cursor.sync,[Q,ae]=B.values,[ne,re]=B.scales,[$,q]=ke.match,be=d.axes[0].side%2==1,Pe=R.ori==0?ee:D,We=R.ori==1?ee:D,me=be?A:b,Le=be?b:A,ct=be?v:g,$e=be?g:v;if(ne!=null?g=$(k,ne)?a(Q,S[k],Pe,0):-10:g=Pe*(ct/me),re!=null?v=q(O,re)?a(ae,S[O],We,0):-10:v=We*($e/Le),R.ori==1){let _t=g;g=v,v=_t}}I&&(d==null||d.cursor.event.type==Un)&&((g<=1||g>=ee-1)&&(g=br(g,ee)),(v<=1||v>=D-1)&&(v=br(v,D))),P?(Zo=g,ea=v,[Gr,Wr]=Y.move(r,g,v)):(ye=g,Ae=v)}let Sn={width:0,height:0,left:0,top:0};function Mn(){Ys(Sn,!1)}let oa,aa,la,ca;function fa(f,d,g,v,b,A,T){Jt=!0,Be=ze=qe._x=qe._y=!1,An(f,d,g,v,b,A,T,!0,!1),f!=null&&(Ke(Vn,Hn,ua,!1),ys(Ca,r,Gr,Wr,ee,D,null));let{left:P,top:I,width:k,height:O}=_e;oa=P,aa=I,la=k,ca=O}function ua(f,d,g,v,b,A,T){Jt=qe._x=qe._y=!1,An(f,d,g,v,b,A,T,!1,!0);let{left:P,top:I,width:k,height:O}=_e,B=k>0||O>0,Q=oa!=P||aa!=I||la!=k||ca!=O;if(B&&Q&&Ys(_e),qe.setScale&&B&&Q){let ae=P,ne=k,re=I,$=O;if(R.ori==1&&(ae=I,ne=O,re=P,$=k),Be&&Zt(L,Vt(ae,L),Vt(ae+ne,L)),ze)for(let q in S){let be=S[q];q!=L&&be.from==null&&be.min!=pe&&Zt(q,Vt(re+$,q),Vt(re,q))}Mn()}else Y.lock&&(Y._lock=!Y._lock,vr(d,!0,f!=null));f!=null&&(Lr(Vn,Hn),ys(Vn,r,ye,Ae,ee,D,null))}function lh(f,d,g,v,b,A,T){if(Y._lock)return;dr(f);let P=Jt;if(Jt){let I=!0,k=!0,O=10,B,Q;R.ori==0?(B=Be,Q=ze):(B=ze,Q=Be),B&&Q&&(I=ye<=O||ye>=ee-O,k=Ae<=O||Ae>=D-O),B&&I&&(ye=ye<Gr?0:ee),Q&&k&&(Ae=Ae<Wr?0:D),vr(null,!0,!0),Jt=!1}ye=-10,Ae=-10,he.fill(null),vr(null,!0,!0),P&&(Jt=P)}function ha(f,d,g,v,b,A,T){Y._lock||(dr(f),ln(),Mn(),f!=null&&ys(Da,r,ye,Ae,ee,D,null))}function ma(){M.forEach(gd),an(r.width,r.height,!0)}Er(si,es,ma);let qr={};qr.mousedown=fa,qr.mousemove=na,qr.mouseup=ua,qr.dblclick=ha,qr.setSeries=(f,d,g,v)=>{let b=ke.match[2];g=b(r,d,g),g!=-1&&Ut(g,v,!0,!1)},je&&(Ke(Ca,y,fa),Ke(Un,y,na),Ke(Na,y,f=>{dr(f),vs(!1)}),Ke(Oa,y,lh),Ke(Da,y,ha),Jn.add(r),r.syncRect=vs);let qs=r.hooks=s.hooks||{};function Ge(f,d,g){_n?ds.push([f,d,g]):f in qs&&qs[f].forEach(v=>{v.call(null,r,d,g)})}(s.plugins||[]).forEach(f=>{for(let d in f.hooks)qs[d]=(qs[d]||[]).concat(f.hooks[d])});let da=(f,d,g)=>g,ke=Fe({key:null,setSeries:!1,filters:{pub:ja,sub:ja},scales:[L,x[1]?x[1].scale:null],match:[Ka,Ka,da],values:[null,null]},Y.sync);ke.match.length==2&&ke.match.push(da),Y.sync=ke;let pa=ke.key,Tn=Yl(pa);function ys(f,d,g,v,b,A,T){ke.filters.pub(f,d,g,v,b,A,T)&&Tn.pub(f,d,g,v,b,A,T)}Tn.sub(r);function ch(f,d,g,v,b,A,T){ke.filters.sub(f,d,g,v,b,A,T)&&qr[f](null,d,g,v,b,A,T)}r.pub=ch;function fh(){Tn.unsub(r),Jn.delete(r),cr.clear(),Xn(si,es,ma),c.remove(),fe?.remove(),Ge("destroy")}r.destroy=fh;function Rn(){Ge("init",s,e),Yo(e||s.data,!1),W[L]?bn(L,W[L]):ln(),Vs=_e.show&&(_e.width>0||_e.height>0),mr=vt=!0,an(s.width,s.height)}return x.forEach(Wo),M.forEach(Gu),t?t instanceof HTMLElement?(t.appendChild(c),Rn()):t(r,Rn):Rn(),r}He.assign=Fe;He.fmtNum=no;He.rangeNum=ii;He.rangeLog=ai;He.rangeAsinh=so;He.orient=Sr;He.pxRatio=ce;He.join=am;He.fmtDate=ao,He.tzDate=ym;He.sync=Yl;{He.addGap=ed,He.clipGaps=fi;let s=He.paths={points:Ql};s.linear=Zl,s.stepped=sd,s.bars=id,s.spline=od}var sc=96,vd=8,di=["#2f8fef","#e8820c","#1fa367","#a45ee5","#e5484d","#12a5b8","#b58900","#d6409f","#6e7fd9","#7a8b3a"];function po(s,e){let[t,r]=[0,s.times.length];for(;t<r;){let i=t+r>>1;s.times[i]<=e+1e-4?t=i+1:r=i}return t===0?null:s.values[t-1]}var or=class{constructor(e,t){this.container=e;this.seek=t;this.set([]),new ResizeObserver(()=>this.resize()).observe(e)}container;seek;charts=[];time=0;set(e){for(let{plot:t}of this.charts)t.destroy();this.container.replaceChildren(),this.charts=e.map((t,r)=>this.chart(t,r))}redraw(){for(let{plot:e}of this.charts)e.redraw(!1)}show(e,t){this.time=e,t.length===this.charts.length&&t.every((i,n)=>i===this.charts[n].curve)||this.set(t);for(let i of this.charts){let n=po(i.curve,e);i.value.textContent=wd(i.curve,n);let o=i.curve.times.at(-1);i.drawnTime!==o&&(i.drawnTime=o,i.plot.setData([i.curve.times,i.curve.values])),this.moveCursor(i)}}moveCursor({plot:e,cursor:t}){let r=e.valToPos(this.time,"x");t.hidden=!(r>=0&&r<=e.over.clientWidth),t.style.transform=`translateX(${r}px)`}chart(e,t){let r=document.createElement("figure"),i=document.createElement("figcaption"),n=document.createElement("button"),o=document.createElement("output");n.textContent=e.name.replaceAll("_"," "),n.title=`${e.name}: fold or unfold`;let a=h=>{r.classList.toggle("folded",h),n.setAttribute("aria-expanded",String(!h))};n.addEventListener("click",()=>a(!r.classList.contains("folded"))),a(t>=vd),n.style.setProperty("--mark",di[t%di.length]),i.append(n,o),r.append(i),this.container.append(r);let l=new He(this.options(e,di[t%di.length]),[e.times,e.values],r);l.over.addEventListener("click",h=>this.seek(l.posToVal(h.offsetX,"x")));let c=document.createElement("i");return c.className="cursor",l.over.append(c),{curve:e,plot:l,cursor:c,value:o,drawnTime:e.times.at(-1)}}options({names:e,isFraction:t},r){let i=o=>getComputedStyle(this.container).getPropertyValue(o).trim(),n=()=>({stroke:()=>i("--soft"),grid:{stroke:()=>i("--line"),width:1},ticks:{show:!1},font:"10px system-ui, sans-serif"});return{width:Math.max(120,this.container.clientWidth-20),height:sc,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:yd(e,t)}},axes:[{...n(),size:20,gap:2},{...n(),size:44,gap:2,space:12,values:(o,a,l,c,h)=>a.map(u=>_d(u,h)),...e?.length?{incrs:[1,2,5,10]}:{}}],series:[{},{stroke:r,width:1.5,spanGaps:!1,paths:e?.length?He.paths.stepped({align:1}):void 0,points:{show:!0,size:4,fill:r,filter:bd}}]}}resize(){let e=Math.max(120,this.container.clientWidth-20);for(let t of this.charts)t.plot.setSize({width:e,height:sc}),this.moveCursor(t)}};function yd(s,e){return s?.length?[0,s.length]:e?[0,1]:(t,r,i)=>{if(r===null||i===null)return[0,1];let n=i-r<1e-5*Math.max(Math.abs(r),Math.abs(i),1e-6);if(n&&r>=0)return[0,i>0?2*i:1];let o=n?Math.max(.5,.1*Math.abs(i)):.08*(i-r);return[r-o,i+o]}}function _d(s,e){let t=[0,1,2,3,4,5].find(r=>Math.abs(e*10**r-Math.round(e*10**r))<1e-6)??9;return Math.abs(s)>=1e5||t>5?s===0?"0":s.toExponential(1):String(Number(s.toFixed(t)))}function bd(s,e){let t=s.data[e],r=i=>t[i]===null||t[i]===void 0;return[...t.keys()].filter(i=>!r(i)&&r(i-1)&&r(i+1))}function wd({unit:s,names:e},t){return t===null?"–":e?.length?e[t-1]??"none yet":`${xd(t)} ${s==="1"?"":s}`.trim()}function xd(s){let e=Math.abs(s);return s===0?"0":e>=1e5||e<.001?s.toExponential(2):s.toPrecision(4)}var go=3e3,Ed=16,pi=class{constructor(e){this.request=e;let t=G("topic");t.addEventListener("change",()=>{this.add(t.value),t.value=""})}request;cards=new Map;types={};list(e){this.types=Object.fromEntries(e);let t=G("topic"),r=e.map(([i,n])=>new Option(`${i}  (${n.replace("/msg/","/")})`,i));t.replaceChildren(new Option("Show a topic…",""),...r),G("topics-box").hidden=!e.length}showMessage(e){this.cards.get(e.name)?.showMessage(e)}show(e){for(let t of this.cards.values())t.show(e)}redrawCurves(){for(let e of this.cards.values())e.curves.redraw()}add(e){if(!e||this.cards.has(e)||this.cards.size>=Ed)return;let t=new vo(e,this.types[e]??"",()=>{this.cards.delete(e),this.request([...this.cards.keys()])});this.cards.set(e,t),G("topics").append(t.box),this.request([...this.cards.keys()])}},vo=class{box=K("div","","topic");curves;rows=new Map;samples=new Map;selection=new Set;table=K("div","","fields");note=K("p","No message yet. A topic without a subscriber may have none.","none");constructor(e,t,r){let[i,n,o]=[K("h3"),K("button","×"),K("div")];n.title=`Hide ${e}`,n.setAttribute("aria-label",n.title),n.addEventListener("click",()=>{this.box.remove(),r()});let a=K("span",e);a.title=t,i.append(a,n),this.box.append(i,this.note,this.table,o),this.curves=new or(o,()=>{})}showMessage({time:e,fields:t,is_cut:r}){this.note.textContent=r?"The first fields of the message:":"",this.note.hidden=!r;for(let[i,n]of t){let o=this.samples.size===0;typeof n=="number"&&this.store(i,e,n),o&&this.samples.size&&this.selection.add(i);let a=this.rows.get(i)??this.row(i,typeof n=="number");a.value.textContent=typeof n=="number"?String(Number(n.toPrecision(6))):n??"–"}this.mark()}show(e){let t=[...this.samples].filter(([r])=>this.selection.has(r));this.curves.show(e,t.map(([,r])=>r))}store(e,t,r){let i=this.samples.get(e);i||this.samples.set(e,i={name:e,unit:"",times:[],values:[]}),!(t<=(i.times.at(-1)??-1))&&(i.times.push(t),i.values.push(r),!(i.times.length<=go)&&(i.times.splice(0,go/2),i.values.splice(0,go/2)))}row(e,t){let[r,i]=[K(t?"button":"div","","field"),K("output")];r.append(K("span",e),i),t&&(r.title="Show or hide its curve",r.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.mark()})),this.table.append(r);let n={row:r,value:i};return this.rows.set(e,n),n}mark(){for(let[e,{row:t}]of this.rows)t instanceof HTMLButtonElement&&t.setAttribute("aria-pressed",String(this.selection.has(e)))}};var Mr=16,Ad=100,Sd=640,yo=class{constructor(e,t,r,i){this.socket=e;this.pack=t;this.earlyEvents=r;this.isServerDrawn=i;e.onclose=()=>this.end("The simulation has ended.")}socket;pack;earlyEvents;isServerDrawn;pilot=new Js((e,t)=>{this.send(e),t&&this.page?.picture.skipPauses()});topics=new pi(e=>this.send({type:"topics",names:e}));page=null;stream=null;lastRequest="";imageNumbers=[];allowsReset=!1;begin(e,t){this.page=e,this.stream=t;for(let r of this.earlyEvents)this.receive(r);this.socket.onmessage=r=>this.receive(r),this.subscribe(e.switches.pictures)}subscribe(e){let t=e?this.pack.head.cameras.map(({name:r})=>r):[];this.send({type:"images",cameras:t,rate:10,width:this.page?.picture.pictureWidth()})}requestView({worldFromCamera:e,camera:t,intrinsics:r}){if(!this.isServerDrawn)return;let i=Math.min(1,Sd/r.width),[n,o]=[r.width,r.height].map(u=>Math.round(i*u)),a=va(e).map(u=>Math.round(1e4*u)/1e4),l=2*Math.atan(r.height/2/r.fy),c={type:"view",camera:t?.name??null,pose:a,width:n,height:o,fovy:l},h=JSON.stringify(c);h!==this.lastRequest&&this.send(c),this.lastRequest=h}control(e,t){this.send({type:"control",action:e,...t===void 0?{}:{speed:t}})}handlePilotKey(e){return this.pilot.handlePilotKey(e)}helpGroups(){return{Pilot:this.pilot.help()}}send(e){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}receive(e){let{page:t,stream:r}=this;if(!t||!r)return;if(typeof e.data=="string")return this.handleMessage(JSON.parse(e.data),t,r);let i=new DataView(e.data),[n,o]=[i.getUint8(0),i.getUint8(1)];n===0&&location.reload(),n===1&&r.push(i.getFloat64(8,!0),new Float32Array(e.data,Mr)),n===2&&this.showImage(o,e.data.slice(Mr),t,r),n===4&&r.setSand(o,new Float32Array(e.data,Mr)),n===5&&this.addMedium(e.data.slice(Mr),t,r),n===6&&r.setPuffs(new Float64Array(e.data,Mr)),n===3&&this.isServerDrawn&&this.showView(e.data.slice(Mr))}async addMedium(e,t,r){let i=await bs(new Uint8Array(e));t.picture.media.add(i,i.head.optics),r.version+=1}handleMessage(e,t,r){if(e.type==="state")t.setState(e.paused,e.speed),this.allowsReset=e.resets,this.pilot.enable(e),t.views.follow(e.vehicle),t.keyboard.showHelp();else if(e.type==="levels")r.setLevels(e.levels);else if(e.type==="samples")for(let i of e.samples)r.sample(...i);else e.type==="readings"?r.version+=Number(t.quantities.setReadings(e.readings)):e.type==="topics"?this.topics.list(e.topics):e.type==="topic"?this.topics.showMessage(e):e.type==="markers"?r.setMarkers(e.markers):e.type==="end"&&this.end(e.why)}async showImage(e,t,r,i){let n=(this.imageNumbers[e]??0)+1;this.imageNumbers[e]=n;let o=await createImageBitmap(new Blob([t],{type:"image/jpeg"}));if(this.imageNumbers[e]!==n)return o.close();r.picture.show(e,o);let{end:a}=i;setTimeout(()=>{i.end===a&&(i.version+=1)},Ad)}showView(e){let t=G("stream");t.hidden=!1,Md(t,e)}end(e){G("message").textContent=e,this.page&&(this.page.isPlaying=!1)}};function Md(s,e){let t=s.src;s.src=URL.createObjectURL(new Blob([e],{type:"image/jpeg"})),t&&URL.revokeObjectURL(t)}function ic(s){let e=location.protocol==="https:"?"wss:":"ws:",t=new WebSocket(`${e}//${location.host}/socket${location.search}`);return t.binaryType="arraybuffer",new Promise((r,i)=>{let n=[],o=!1;t.onerror=t.onclose=()=>i(new Error("The simulation cannot be reached.")),t.onmessage=a=>{let{data:l}=a;if(o||typeof l=="string"||new DataView(l).getUint8(0)!==0){n.push(a);return}o=!0,bs(new Uint8Array(l.slice(Mr))).then(c=>r(new yo(t,c,n,s)),i)}})}var Td=["clear","dusk","cloudy"],gi=.03,vi=class{constructor(e){this.page=e;let t=G("view");document.addEventListener("keydown",r=>this.onKeyDown(r)),t.addEventListener("keydown",r=>this.turnView(r)),t.addEventListener("pointerdown",r=>{if(r.target.closest("button, .stick"))return;t.setPointerCapture(r.pointerId);let i=r.button!==0||r.shiftKey;this.dragState={x:r.clientX,y:r.clientY,isPan:i}}),t.addEventListener("pointermove",r=>this.drag(r)),t.addEventListener("pointerup",()=>this.dragState=null),t.addEventListener("pointercancel",()=>this.dragState=null),t.addEventListener("contextmenu",r=>r.preventDefault()),t.addEventListener("wheel",r=>{r.preventDefault(),e.views.zoom(Math.exp(.001*r.deltaY))},{passive:!1}),this.showHelp()}page;dragState=null;showHelp(){Ra(this.groups())}drag(e){if(!this.dragState)return;let t=G("view").clientHeight,[r,i]=[e.clientX-this.dragState.x,e.clientY-this.dragState.y];this.page.views.drag(r/t,i/t,this.dragState.isPan),Object.assign(this.dragState,{x:e.clientX,y:e.clientY})}turnView(e){let r={ArrowLeft:[gi,0],ArrowRight:[-gi,0],ArrowUp:[0,gi],ArrowDown:[0,-gi]}[e.key];!r||e.ctrlKey||e.altKey||e.metaKey||(e.preventDefault(),e.stopPropagation(),this.page.views.drag(r[0],r[1],e.shiftKey))}onKeyDown(e){let{page:t}=this;if(e.ctrlKey||e.altKey||e.metaKey)return;let r=e.target;if((r instanceof HTMLSelectElement||r instanceof HTMLInputElement)&&!/^[a-z?]$/.test(e.key)||e.key===" "&&r instanceof HTMLButtonElement||/^(Home|End)$/.test(e.key)&&G("help").contains(r)||t.connection?.handlePilotKey(e))return;let n=e.shiftKey?e.key.toLowerCase():e.key,o=this.actions()[n];o&&(e.preventDefault(),o())}actions(){let{page:e}=this,t=i=>()=>{let n=e.player.levels.findIndex(({trial:o,level:a})=>o===e.player.trial&&a.end>e.time);e.go(Math.max(0,(n<0?e.player.levels.length-1:n)+i))},r=i=>()=>{e.switches.sun=Td[i],e.draw()};return{" ":()=>e.play(),",":()=>e.step(-1),".":()=>e.step(1),ArrowLeft:()=>e.seek(e.time-1),ArrowRight:()=>e.seek(e.time+1),Home:()=>e.seek(e.player.start),End:()=>e.seek(e.player.end),"[":t(-1),"]":t(1),"<":()=>e.changeSpeed(-1),">":()=>e.changeSpeed(1),o:()=>e.show("orbit"),b:()=>e.show("chase"),v:()=>e.show("camera"),m:()=>e.show("map"),p:()=>e.show("file"),z:()=>e.toggle("state"),h:()=>e.views.restoreInitial(),k:()=>e.views.toggleFollowing(),r:()=>e.reset(),"+":()=>e.views.zoom(.9),"=":()=>e.views.zoom(.9),"-":()=>e.views.zoom(1.1),x:()=>e.toggle("clear"),c:()=>e.toggle("pictures"),f:()=>e.toggle("frames"),l:()=>e.toggle("labels"),t:()=>e.toggle("trails"),y:()=>e.clearTrails(),s:()=>e.toggle("sonars"),n:()=>e.toggleTheme(),1:r(0),2:r(1),3:r(2),"?":Qs}}groups(){let{page:e}=this,t=e.connection?"reset vehicles and objects":"start of the level",r=[{keys:", .",action:"one row back, forward"},{keys:"← →",action:"one second back, forward (in the view: rotate it)"},{keys:"[ ]",action:"previous, next level"},{keys:"Home End",action:"start, end"}],i={Time:[{keys:"space",action:"play, pause"},...e.connection?[{keys:".",action:"one step"}]:r,{keys:"< >",action:"slower, faster"},...e.connection&&!e.connection.allowsReset?[]:[{keys:"r",action:t}]],View:[{keys:"o b v m",action:"orbit, behind the vehicle, next camera, map from above"},...e.pack.head.file_view?[{keys:"p",action:"the camera of the scene file"}]:[],{keys:"k",action:"orbit follows the vehicle, or stays"},{keys:"arrows, drag",action:"rotate; with Shift or the right button: move"},{keys:"+ -, wheel",action:"nearer, farther"},{keys:"h",action:"first view"},{keys:"x",action:"clear water, or the scene's fog"},{keys:"1 2 3",action:"clear sky, dusk, cloudy"}],Shown:[{keys:"c",action:"images of the cameras"},{keys:"z",action:"state of the vehicle; a click on a number draws its curve"},{keys:"f l",action:"frames, names"},{keys:"t y",action:"trails; restart them"},{keys:"s",action:"beams and fans of sonars"},{keys:"n",action:"light or dark colours"},{keys:"?",action:"these keys"}]};if(!e.connection)return i;let n=e.connection.pilot;for(let o of Object.values(i).flat())o.keys=o.keys.split(" ").map(a=>n.isReserved(a)?`Shift+${a}`:a).join(" ");return{...i,...e.connection.helpGroups()}}};function oc({water:s,view:e}){let t=s.media?.[0];return t?Math.min(...t.absorption.map((i,n)=>i+t.scattering[n]))*Math.hypot(...e.at.map((i,n)=>i-e.pose[n]))>3:!0}var yi=class{entries=[];clearMedium;constructor(e){let{media:t,clear:r}=e.head.water;for(let i of t??[])this.add(e,i);this.clearMedium=r?nc(e,r):null}add(e,t){this.entries.length>=64&&this.entries.splice(1,1),this.entries.push(nc(e,t))}mediumAt(e){if(!this.entries.length)return null;let t=e.signal("beam_attenuation"),r=t===void 0?this.entries[0]:Rd(this.entries,t),i=e.signal("exposure_level");if(i===void 0)return r;let n=2**i/r.exposure;return{...r,exposure:2**i,clear_exposure:n*r.clear_exposure}}clearOptics(e){return e&&this.clearMedium&&{...this.clearMedium,exposure:e.clear_exposure}}};function Rd(s,e){let t=s.map(({absorption:r,scattering:i})=>Math.abs(r[1]+i[1]-e));return s[t.lastIndexOf(Math.min(...t))]}function nc(s,e){let t=s.numbers(e.transform.values);return{...e,transform:{...e.transform,values:t}}}var ac=200,lc=5,_o=6e3,Pd=1200,bo=180/Math.PI,_i=class{constructor(e,t){this.head=e;this.rays=t}head;rays;histories=new Map;readings=[];storeTime=-1/0;trial=-1;vehicle=0;setReadings(e){let t=JSON.stringify(e)!==JSON.stringify(this.readings);return this.readings=e,t}compute(e,t,r){this.vehicle=r;let i=this.readings.map(([n,o,a])=>({name:n,unit:o,value:a}));return[...this.motionQuantities(e,t),...i]}store(e,t){if(e<this.storeTime&&this.histories.clear(),!(e>=this.storeTime&&e<this.storeTime+1/lc)){this.storeTime=e;for(let{name:r,unit:i,value:n}of t){let o=this.historyOf(r,i);o.times.push(e),o.values.push(n),!(o.times.length<=_o)&&(o.times.splice(0,_o/2),o.values.splice(0,_o/2))}}}history({name:e,unit:t},r){if(r.isLive)return this.historyOf(e,t);r.trial!==this.trial&&this.histories.clear(),this.trial=r.trial;let i=this.histories.get(e);if(i)return i;let n=this.historyOf(e,t),o=r.end-r.start,a=Math.max(2,Math.min(Pd,Math.ceil(o*lc)));for(let l=0;l<a;++l){let c=r.start+o*l/(a-1),h=this.motionQuantities(r.snapshot(c),r,e);n.times.push(c),n.values.push(h.find(u=>u.name===e)?.value??null)}return n}historyOf(e,t){let r=this.histories.get(e);return r||this.histories.set(e,r={name:bi(e),unit:t,times:[],values:[]}),r}motionQuantities(e,t,r=""){let i=this.head.vehicles[this.vehicle];if(!i)return[];let n=cc(this.head,e,i.body),[o,a,l]=de(n),c=this.zAxisSign(i.body),h=Math.atan2(n[0],n[4])*bo,u=[{name:"depth",unit:"m",value:this.head.water.surface_height-l},{name:"heading",unit:"deg",value:Math.round(10*(h+360))/10%360},{name:"roll",unit:"deg",value:Math.atan2(c*n[9],c*n[10])*bo},{name:"pitch",unit:"deg",value:Math.asin(Math.max(-1,Math.min(1,n[8])))*bo},{name:"speed",unit:"m/s",value:t.speed(i.body,e.time)}];(!r||r==="altitude")&&u.splice(1,0,{name:"altitude",unit:"m",value:this.altitude([o,a,l],i.name,e)});let m=["x","y","z"].map(y=>e.signal(`water/${i.name}/${y}`)??0),p=Math.hypot(...m);return(p>=.005||r)&&u.push({name:"current",unit:"m/s",value:p}),u}zAxisSign(e){let t=this.head.bodies.find(({name:r})=>r===e);return t&&nt(t.pose)[10]<0?-1:1}altitude(e,t,r){let i=Me(e,[0,0,-ac]),n=a=>cc(this.head,r,a),o=this.rays.cast(e,i,n,a=>a.vehicle===t);return o<1?o*ac:null}};function cc(s,e,t){let r=s.bodies.find(({name:i})=>i===t);return e.poses.get(t)??nt(r?.pose??[0,0,0,1,0,0,0])}function bi(s){let[e,t]=[s.split("/")[0],s.slice(s.indexOf("/")+1)];return t===s||e==="joint"||t.toLowerCase().includes(e)?t:`${t} ${e}`}var fc=100,Ld=["depth","speed"],Id={deg:"°",1:"×"},wi=class{constructor(e,t,r,i){this.quantities=e;this.player=t;this.redraw=i;this.curves=new or(G("state"),r)}quantities;player;redraw;cells=new Map;selection=new Set;curves;hasSelection=!1;displayTime=0;isUpdatePending=!1;lastState=null;values=[];show(e,t,r){this.lastState=[e,t,r];let i=performance.now();i-this.displayTime>=fc||!this.player.isLive?(this.displayTime=i,this.values=this.quantities.compute(e,this.player,t),this.player.isLive&&this.quantities.store(e.time,this.values),this.values.forEach(a=>this.fill(a))):this.isUpdatePending||(this.isUpdatePending=!0,setTimeout(()=>{this.isUpdatePending=!1,this.show(...this.lastState)},fc)),G("hud").hidden=!r||!this.values.length,!this.hasSelection&&this.values.length&&this.selectInitial();let o=this.selectedCurves();G("state-box").hidden=!o.length,o.length&&this.curves.show(e.time,o)}redrawCurves(){this.curves.redraw()}selectInitial(){this.hasSelection=!0,this.player.isLive&&!this.player.curves.length&&!this.player.levels.length&&Ld.forEach(e=>this.selection.add(e)),this.mark()}selectedCurves(){return this.values.filter(({name:t})=>this.selection.has(t)).map(t=>this.quantities.history(t,this.player))}fill({name:e,unit:t,value:r}){let i=this.cells.get(e)??this.cell(e);i.value.textContent=kd(r,t)}cell(e){let t=K("button","",e.startsWith("joint/")?"joint":""),r=K("output");t.append(K("span",bi(e)),r),t.title=`${bi(e)}: show or hide its curve`,t.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.hasSelection=!0,this.mark(),this.redraw()});let i={button:t,value:r};return this.cells.set(e,i),this.mark(),G("hud").append(t),i}mark(){for(let[e,{button:t}]of this.cells)t.setAttribute("aria-pressed",String(this.selection.has(e)))}};function kd(s,e){if(s===null)return"–";let t={deg:1,m:2,"m/s":2,N:1,"%":0}[e]??2,r=s.toFixed(t).replace(/^-(0(\.0*)?)$/,"$1"),i=Id[e]??` ${e}`;return`${r.replace("-","−")}${i}`}var Fd={orbit:["Orbit","Orbit around the vehicle (o)"],chase:["Chase","From behind the vehicle (b)"],camera:["Camera","Image of a camera (v)"],map:["Map","From above, north up (m)"],file:["File","From the <camera> of the scene file (p)"]},Cd={clear:["Clear water","Water without fog (x)"],state:["State","Depth, heading, joints and more; a click on a number draws its curve (z)"],pictures:["Cameras","Images of the cameras (c)"],frames:["Frames","Coordinate frames with their names (f)"],trails:["Trails","Trails of bodies (t)"],sonars:["Sonars","Beams and fans (s)"]};function uc(s,e,t){for(let i of e){let[n,o]=Fd[i],a=K("button",n);a.title=o,a.dataset.mode=i,a.setAttribute("role","radio"),a.addEventListener("click",()=>s.show(i)),G("modes").append(a)}let r=G("camera");t.forEach((i,n)=>r.append(new Option(i,String(n)))),r.addEventListener("change",()=>{s.views.camera=Number(r.value),s.refresh()})}function hc(s){let{sensors:e,cameras:t,vehicles:r}=s.pack.head,i={sonars:e.length,pictures:t.length,state:r.length};for(let[n,[o,a]]of Object.entries(Cd)){if(i[n]===0)continue;let l=K("button",o);l.dataset.switch=n,l.title=a,l.addEventListener("click",()=>s.toggle(n)),G("switches").append(l)}}function mc({views:s,switches:e,pack:t}){for(let i of G("modes").querySelectorAll("button"))i.setAttribute("aria-checked",String(i.dataset.mode===s.mode));for(let i of G("switches").querySelectorAll("button"))i.setAttribute("aria-pressed",String(e[i.dataset.switch]));let r=G("camera");r.hidden=s.mode!=="camera"||t.head.cameras.length<2,r.value=String(s.camera)}var dc=["orbit","chase","camera","map","file"],Nd=.9,Od=.4,xi=class{constructor(e,t,r){this.head=e;this.models=t;this.rays=r;this.orbit=wo(e.view),this.restoreInitial()}head;models;rays;mode="orbit";camera=0;version=0;vehicle=0;holdOffset=null;orbit;file=null;chaseAzimuth=0;height=12;mapOffset=[0,0];follow(e){e!==this.vehicle&&(this.vehicle=e,this.version+=1)}toggleFollowing(){this.holdOffset=this.holdOffset?null:this.displacement(),this.version+=1}restoreInitial(){this.version+=1,this.holdOffset=null,this.orbit=wo(this.head.view),this.file=this.head.file_view&&wo(this.head.file_view),this.chaseAzimuth=0,this.mapOffset.fill(0),this.height=Math.max(6,2*this.orbit.distance)}viewCamera(e,t){let{view:r,file_view:i}=this.head,n=_a(e,t,(this.mode==="file"&&i?i:r).fovy),o=this.mode==="camera"?this.head.cameras[this.camera]:void 0;if(o){let l=Eo(o,e,t);return{worldFromCamera:this.models.worldFromMount(o),intrinsics:l,isExternal:!1,camera:o}}let a;if(this.mode==="map"){let[l,c]=Me(this.centre(),[...this.mapOffset,0]);a=Ln([l,c,this.centre()[2]+this.height],[l,c,this.centre()[2]],[0,1,0])}else if(this.mode==="chase"&&this.base()){let l=this.base(),c=Math.atan2(l[4],l[0])+Math.PI+this.chaseAzimuth;a=this.chasePose(c,Math.max(.15,this.orbit.elevation))}else if(this.mode==="file"&&this.file)a=Rs(this.file);else{let l=Me(this.orbit.target,this.holdOffset??this.displacement());a=Rs({...this.orbit,target:l})}return{worldFromCamera:a,intrinsics:n,isExternal:!0,camera:null}}drag(e,t,r){if(this.version+=1,this.mode==="map"||r)return this.move(e,t);this.mode==="chase"?this.chaseAzimuth-=4*e:this.activeView().azimuth-=4*e;let i=this.activeView();i.elevation=xo(i.elevation+3*t,-1.55,1.55)}zoom(e){this.version+=1,this.mode==="map"?this.height=xo(this.height*e,.5,2e3):this.activeView().distance=xo(this.activeView().distance*e,.1,2e3)}move(e,t){if(this.mode==="map"){let n=2*this.height*Math.tan(this.head.view.fovy/2);this.mapOffset[0]-=e*n,this.mapOffset[1]+=t*n;return}let r=this.activeView(),i=Rs(r);r.target=Me(r.target,[i[0],i[4],i[8]],-e*r.distance),r.target=Me(r.target,[i[1],i[5],i[9]],t*r.distance)}activeView(){return this.mode==="file"&&this.file?this.file:this.orbit}chasePose(e,t){let r=this.centre(),{distance:i}=this.orbit,n=Rs({target:r,azimuth:e,elevation:t,distance:i}),o=this.head.vehicles[this.vehicle].name,a=m=>this.models.body(m),l=.05*i,c=[[0,0],[l,0],[-l,0],[0,l],[0,-l]].map(([m,p])=>this.rays.cast(r,Re(n,[m,p,0]),a,y=>y.vehicle===o)),h=Math.min(...c);if(h>=1)return n;let u=Math.max(Math.min(Od,i),Nd*h*i);return Rs({target:r,azimuth:e,elevation:t,distance:u})}base(){let e=this.head.vehicles[this.vehicle];return e?this.models.body(e.body):null}displacement(){let e=this.head.vehicles[this.vehicle],t=this.head.bodies.find(({name:r})=>r===e?.body);return t?Me(this.centre(),t.pose.slice(0,3),-1):[0,0,0]}centre(){let e=this.base();return e?Re(e,[0,0,0]):this.head.view.at}};function wo(s){let e=Me(de(nt(s.pose)),s.at,-1),t=Math.hypot(...e);return{target:[...s.at],azimuth:Math.atan2(e[1],e[0]),elevation:Math.asin(e[2]/t),distance:t}}function Rs({target:s,azimuth:e,elevation:t,distance:r}){let[i,n]=[Math.cos(t),Math.sin(t)],o=wt([i*Math.cos(e),i*Math.sin(e),n]);return Ln(Me(s,o,r),s)}function Eo(s,e,t){let r=Math.min(t/s.height,e/s.width);return{width:e,height:t,fx:s.fx*r,fy:s.fy*r,cx:(e-1)/2+(s.cx-(s.width-1)/2)*r,cy:(t-1)/2+(s.cy-(s.height-1)/2)*r,skew:s.skew*r,near:s.near,far:s.far}}function xo(s,e,t){return Math.min(t,Math.max(e,s))}var pc=[.1,.25,.5,1,2,5,10,20],Ei=class{constructor(e,t,r,i,n,o){this.pack=e;this.player=t;this.picture=r;this.views=i;this.connection=n;this.switches.clear=oc(e.head),this.quantities=new _i(e.head,o),this.hud=new wi(this.quantities,t,a=>this.seek(a),()=>this.draw()),this.levels=new Ks(t,a=>{this.go(a)}),this.thrusters=new $s(e.head),this.keyboard=new vi(this),this.build(),requestAnimationFrame(a=>this.tick(a))}pack;player;picture;views;connection;time=0;isPlaying=!1;speed=1;switches={clear:!0,pictures:!0,state:!0,frames:!1,labels:!1,trails:!0,sonars:!0,sun:""};curves=new or(G("curves"),e=>this.seek(e));quantities;hud;levels;thrusters;keyboard;lastTick=performance.now();drawnKey="";note="";async go(e){let t=this.player.levels[e];!t||this.connection||(await this.select(t.trial),this.seek(t.level.start))}async select(e){if(e===this.player.trial)return;await this.player.select(e),G("message").textContent=Ta(this.player)?"This trial has no recorded motion.":this.note,this.curves.set(this.player.curves);let{start:t,end:r}=this.player;this.levels.mark(t,r),Object.assign(G("time"),{min:String(t),max:String(r)})}seek(e){this.connection||(this.time=Math.min(this.player.end,Math.max(this.player.start,e)),this.draw())}play(e=!this.isPlaying){this.isPlaying=e,e&&!this.connection&&this.time>=this.player.end-1e-6&&(this.time=this.player.start),this.connection?.control(e?"play":"pause"),G("play").textContent=e?"Pause":"Play"}step(e){this.play(!1),this.connection?this.connection.control("step"):this.seek(this.time+e/30)}reset(){this.connection?this.connection.control("reset"):this.seek(this.player.levels[_r(this.player,this.time)]?.level.start??this.player.start)}setSpeed(e,t=!0){this.speed=e;let r=G("speed");[...r.options].some(({value:i})=>i===String(e))||r.append(gc(e)),r.value=String(e),t&&this.connection?.control("speed",e)}setState(e,t){this.isPlaying=!e,G("play").textContent=e?"Play":"Pause",this.setSpeed(t,!1)}changeSpeed(e){let t=n=>n||1/0,r=this.speeds().filter(n=>(t(n)-t(this.speed))*e>0),i=e>0?r[0]:r.at(-1);i!==void 0&&this.setSpeed(i)}speeds(){return this.connection?[...pc,0]:pc}show(e){this.modes().includes(e)&&(e==="camera"&&this.views.mode==="camera"&&(this.views.camera=(this.views.camera+1)%this.pack.head.cameras.length),this.views.mode=e,this.refresh())}modes(){let{cameras:e,file_view:t}=this.pack.head;return dc.filter(r=>(r!=="camera"||e.length)&&(r!=="file"||t))}toggle(e){this.switches[e]=!this.switches[e],e==="frames"&&(this.switches.labels=this.switches.frames),this.connection?.subscribe(this.switches.pictures),this.refresh()}clearTrails(){this.player.clearTrails(this.time),this.draw()}toggleTheme(){let e=document.documentElement;e.dataset.theme=e.dataset.theme==="dark"?"light":"dark",this.curves.redraw(),this.hud.redrawCurves(),this.connection?.topics.redrawCurves()}draw(){this.player.isLive&&(this.time=this.player.end);let e=this.player.snapshot(this.time);this.hud.show(e,this.views.vehicle,this.switches.state);let t=this.picture.draw(this.player,e,this.views,this.switches);t&&this.connection?.requestView(t),this.levels.show(this.time),this.curves.show(this.time,this.player.curves),G("curves-box").hidden=!this.player.curves.length,this.connection?.topics.show(this.time),this.thrusters.show(e);let r=[...document.querySelectorAll("aside > section")];document.body.classList.toggle("bare",r.every(({hidden:i})=>i)),G("time").value=String(this.time),G("clock").textContent=this.player.isLive?`${this.time.toFixed(2)} s`:`${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`}tick(e){requestAnimationFrame(a=>this.tick(a));let t=Math.min(.25,(e-this.lastTick)/1e3);this.lastTick=e,this.isPlaying&&!this.connection&&(this.time=Math.min(this.player.end,this.time+t*this.speed),this.time>=this.player.end&&this.play(!1));let{clientWidth:r,clientHeight:i}=this.picture.canvas,o=[this.time,this.player.end,r,i,this.views.version,this.player.version].join()+JSON.stringify(this.switches);o!==this.drawnKey&&!document.hidden&&this.picture.isReady()&&(this.drawnKey=o,this.draw())}refresh(){mc(this),this.draw()}build(){uc(this,this.modes(),this.pack.head.cameras.map(({name:r})=>r)),hc(this);let e=G("speed");e.append(...this.speeds().map(gc)),e.addEventListener("change",()=>this.setSpeed(Number(e.value))),this.setSpeed(1,!1);let t=G("time");t.addEventListener("input",()=>this.seek(Number(t.value))),G("play").addEventListener("click",()=>this.play()),G("step").addEventListener("click",()=>this.step(1)),G("back").addEventListener("click",()=>this.step(-1)),G("back").hidden=G("line").hidden=this.player.isLive,G("help-button").addEventListener("click",Qs),this.refresh()}};function gc(s){return new Option(s?`${s}×`:"fastest",String(s))}var Ai=class{constructor(e,t){this.pack=e;this.head=t}pack;head;trial=-1;current=null;surfaceAt(e,t){let{surface:r,trials:i}=this.head;if(!r)return null;if(!this.current||e!==this.trial){let n=i?.[e]?.surface??r;this.trial=e,this.current={waves:Si(this.pack,n.waves),ripples:Si(this.pack,n.ripples)}}return{...this.current,time:t.time,scale:t.signal("wave_scale")??r.scale}}};function Si(s,e){if(!e)return null;let t=s.numbers(e),r=t.length/5,[i,n,o,a,l]=[0,1,2,3,4].map(c=>t.subarray(r*c,r*(c+1)));return{amplitude:i,omega:n,kx:o,ky:a,phase:l}}var Dd=9.81,Ud=2*Math.PI/65536,Mi=class{constructor(e,t){this.pack=e;this.head=t}pack;head;trial=-1;ripples=null;waves=null;tile=null;scale=NaN;surfaceAt(e,t){let{caustics:r,trials:i}=this.head;if(!r)return null;if(!this.ripples||e!==this.trial){let{phases:o,waves:a}=i?.[e]?.caustics??r;this.trial=e,this.ripples=Vd(this.pack,r,this.pack.numbers(o)),this.waves=Si(this.pack,a),this.tile=null}let n=t.signal("wave_scale")??r.scale;return(!this.tile||n!==this.scale)&&(this.tile=this.waves?zd(this.ripples,Bd(r,this.waves,n)):this.ripples,this.scale=n),{time:t.time,scale:n,tile:this.tile,waves:this.waves}}};function Vd(s,e,t){let[r,i]=[e.columns,e.rows].map(o=>s.numbers(o)),n=2*Math.PI/e.edge;return{columns:r,rows:i,amplitude:Float64Array.from(s.numbers(e.amplitudes),o=>e.amplitude*o),omega:Float64Array.from(r,(o,a)=>{let l=n*Math.hypot(o,i[a]);return Math.sqrt(Dd*l+e.tension*l**3)}),phase:Float64Array.from(t,o=>Ud*o)}}function Bd({edge:s,wave_lengths:e},t,r){let i=2*Math.PI/s,n=Array.from(t.kx,(c,h)=>2*Math.PI/Math.hypot(c,t.ky[h])),o=[...n.keys()].filter(c=>n[c]<e[1]&&n[c]>=e[0]),a=Int16Array.from(o,c=>vc(t.kx[c]/i)),l=Int16Array.from(o,c=>vc(t.ky[c]/i));return{columns:a,rows:l,amplitude:Float64Array.from(o,(c,h)=>r*t.amplitude[c]*2*Math.PI/n[c]/(i*Math.hypot(a[h],l[h]))),omega:Float64Array.from(o,c=>t.omega[c]),phase:Float64Array.from(o,c=>t.phase[c])}}function vc(s){return Math.abs(s%1)===.5?2*Math.round(s/2):Math.round(s)}function zd(s,e){let t=r=>Float64Array.from([...s[r],...e[r]]);return{columns:Int16Array.from([...s.columns,...e.columns]),rows:Int16Array.from([...s.rows,...e.rows]),amplitude:t("amplitude"),omega:t("omega"),phase:t("phase")}}function yc({columns:s,rows:e,amplitude:t,omega:r,phase:i},n,o,a,l){let{reals:c,imaginaries:h}=l;c.fill(0),h.fill(0);let u=o-1;for(let m=0;m<s.length;++m){let[p,y]=[s[m],e[m]],_=t[m]*Math.PI/n,w=i[m]-r[m]*a,E=_*Math.cos(w),x=_*Math.sin(w),M=(y&u)*o+(p&u),S=(-y&u)*o+(-p&u);c[M]+=-p*x-y*E,h[M]+=p*E-y*x,c[S]+=-p*x+y*E,h[S]+=-p*E-y*x}}var Ti=class{constructor(e,t){this.heap=e;this.positions=t;this.initialHeights=Float32Array.from({length:t.length/3},(r,i)=>t[3*i+2]-e.corner[2]),this.heights=this.initialHeights.slice()}heap;positions;heights;initialHeights;removals=[];lastHeights=null;set(e){return e===this.lastHeights?!1:(this.lastHeights=e,this.heights.set(e.subarray(0,this.heights.length)),!0)}apply(e){let t=this.removals,r=e.length>=t.length&&t.every((i,n)=>i===e[n]);if(r&&e.length===t.length)return!1;r||this.heights.set(this.initialHeights);for(let{position:i}of r?e.slice(t.length):e)i?this.remove(i):this.heights.set(this.initialHeights);return this.removals=e,!0}surface(){let{heap:e,heights:t}=this,[r,i]=e.columns,n=Float32Array.from(this.positions),o=new Int16Array(n.length),a=(l,c,h)=>{let[u,m]=[Math.max(0,l-1),Math.min(c-1,l+1)];return(h(m)-h(u))/((m-u)*e.cell)};for(let l=0;l<r;++l)for(let c=0;c<i;++c){let h=l*i+c,u=a(l,r,y=>t[y*i+c]),m=a(c,i,y=>t[l*i+y]),p=32767/Math.hypot(u,m,1);n[3*h+2]=e.corner[2]+t[h],o.set([-u*p,-m*p,p],3*h)}return{positions:n,normals:o}}remove([e,t,r]){let{heap:i,heights:n}=this,[o,a]=i.columns,l=i.reach**2,c=(y,_)=>[Math.max(0,Math.floor((y-i.reach)/i.cell)),Math.min(_-1,Math.ceil((y+i.reach)/i.cell))],[[h,u],[m,p]]=[c(e,o),c(t,a)];for(let y=h;y<=u;++y)for(let _=m;_<=p;++_){let w=y*a+_;(y*i.cell-e)**2+(_*i.cell-t)**2+(n[w]-r)**2<l&&(n[w]=Math.max(0,n[w]-i.bite))}}};var _c=`// Provides: pixels without a surface: the water's far colour, range inf, id 0.
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
`;var bc=`// Provides: one triangle over the whole image at the far plane.
// Needs: nothing; three vertices without attributes.
// Depth 1 passes only where nothing has been drawn.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
`;var wc=`// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
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
`;var xc=`// Provides: the Gaussian of a level of blur along its rows.
// Needs: gaussian.glsl; the texture of the level.
// blurred.frag.glsl adds that along the columns.
#include "gaussian.glsl"
uniform sampler2D level_0;
out vec4 light_out;

void main() {
    light_out = gaussian(level_0, ivec2(1, 0));
}
`;var Ec=`// Provides: caustic_excess(place, depth, depths, swell_frame), the gain of the sun's beam by the moving surface, minus 1.
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
#if N_SLICES > 4
    float layer = step(0.5 * float(N_SLICES), level);  // of the maps 0 to 3, or 2 to 5
#else
    const float layer = 0.0;
#endif
    vec4 shares = max(1.0 - abs(vec4(0.0, 1.0, 2.0, 3.0) + 2.0 * layer - level), 0.0);
    float excess = dot(READ_MAP(place, layer), shares);
    float far = depths.w / max(z, depths.w);
    return (1.0 + excess * min(z / depths.x, 1.0) * far * far) * density - 1.0;
}
`;var Ac=`// Provides: the block Caustics, the numbers of caustics that are constant in an image.
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
`;var Sc=`// Provides: daylight(facing, up_cosine, share, depth), the light of sun and sky under water; albedo_of(stored), a surface's albedo.
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
`;var Mc=`// Provides: the optical depth of a lump of a cloud up to four ranges, and its light; the renderer adds them up.
// Needs: frame.glsl, optics.glsl, clouds.glsl, open_water.glsl; lamps.glsl with LAMPS; the outputs of cloud.vert.glsl.
// Closed form of a Gaussian along a ray: particles/puffs.py; the light: physical/cloud_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "clouds.glsl"
#include "cloud_edge.glsl"
#include "open_water.glsl"
#ifdef LAMPS
#include "lamps.glsl"
#endif
uniform sampler2D surface_image;
flat in vec4 v_place;
flat in float v_depth;
layout(location = 0) out vec4 layers_out;    // optical depth up to each layer
layout(location = 1) out vec4 lamplight_out; // rgb: optical depth times lamplight scattered once; a: optical depth
layout(location = 2) out vec4 daylight_out;  // rgb: optical depth times excess of daylight over open water

vec4 error_function(vec4 x) {  // Abramowitz and Stegun 7.1.27, to 5e-4
    vec4 t = abs(x);
    vec4 root = 1.0 + t * (0.278393 + t * (0.230389 + t * (0.000972 + t * 0.078108)));
    root *= root;
    return sign(x) * (1.0 - 1.0 / (root * root));
}

#ifdef LAMPS
float phase(float cosine) {
    float q = sqrt(sqrt(clamp(0.5 - 0.5 * cosine, 0.0, 1.0)));
    float sum = phase_high.w;
    sum = sum * q + phase_high.z;
    sum = sum * q + phase_high.y;
    sum = sum * q + phase_high.x;
    sum = sum * q + phase_low.w;
    sum = sum * q + phase_low.z;
    sum = sum * q + phase_low.y;
    return exp(sum * q + phase_low.x);
}
#endif

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    vec2 pixel = float(CLOUD_EDGE) * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    float foot = dot(ray, v_place.xyz);
    vec3 offset = v_place.xyz - foot * ray;
    float inverse = 0.70710678 / v_place.w;
    float peak = 0.5 * v_depth * exp(-dot(offset, offset) * inverse * inverse);
    if (peak < 1e-5) discard;
    vec4 ranges = cloud_layers.x + cloud_layers.y * vec4(0.0, 1.0, 2.0, 3.0);
    float begin = error_function(vec4(-foot * inverse)).x;
    vec4 depths = peak * max(error_function((ranges - foot) * inverse) - begin, 0.0);
    float total = peak * max(1.0 - begin, 0.0);
    float middle = max(foot, 0.5 * v_place.w);
    vec3 point = middle * ray;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b, as in lamp_veil.glsl
    vec3 kept = exp(loss * -middle);
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 day = cloud_colour.rgb * daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 sum = vec3(0.0);
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), max(0.5 * v_place.w, 0.1));
        vec3 direction = towards / distance;
        float cone = lamp_position[i].w > -1.0
            ? clamp((dot(lamp_axis[i].xyz, direction) - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
        float part = 3.14159265 * phase(dot(direction, ray)) * cone * cone * (3.0 - 2.0 * cone) / (distance * distance);
        sum += lamp_light[i].rgb * exp(loss * -distance) * part;
    }
    sum *= cloud_colour.rgb / max(max(cloud_colour.r, cloud_colour.g), max(cloud_colour.b, 1e-3));
#endif
    layers_out = depths;
    lamplight_out = vec4(total * kept * sum, total);
    daylight_out = vec4(total * kept * (day - open_water(pixel, size)), 0.0);
}
`;var Tc=`// Provides: the rectangle around a lump of a cloud of sediment.
// Needs: frame.glsl, optics.glsl; four vertices for each instance: its centre, width, and optical depth through its centre.
// Three widths around the centre; the whole image if the camera is inside.
#include "optics.glsl"
#include "cloud_edge.glsl"
uniform sampler2D surface_image;
in vec4 place;   // xyz: centre, camera frame [m]; w: width sigma [m]
in float depth;  // optical depth along a whole ray through the centre
flat out vec4 v_place;
flat out float v_depth;

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    v_place = place;
    v_depth = depth;
    float ahead = -place.z;
    float reach_of_lump = 3.0 * place.w;
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    if (ahead < -reach_of_lump) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    } else if (ahead < 1.5 * reach_of_lump) {
        gl_Position = vec4(corner, 0.0, 1.0);
    } else {
        vec2 slope = place.xy / ahead - ray_first.xy;
        float row = slope.y / ray_row.y;
        vec2 pixel = vec2((slope.x - row * ray_row.x) / ray_column.x, row);
        float focal = inversesqrt(abs(ray_column.x * ray_row.y));
        float stretch = 1.0 + length(place.xy) / ahead;  // off the axis the outline is longer
        float radius = stretch * focal * reach_of_lump / sqrt(ahead * ahead - reach_of_lump * reach_of_lump);
        gl_Position = vec4(2.0 * (pixel + radius * corner) / size - 1.0, 0.0, 1.0);
    }
}
`;var Rc=`// Provides: CLOUD_EDGE, the edge of a texel of the textures of clouds [px].
// Needs: nothing. physical/cloud_pass.py has the same number.
// Clouds are smooth, and their layers keep them apart from surfaces.
#define CLOUD_EDGE 8
`;var Pc=`// Provides: the block Clouds: the ranges of the layers in which clouds of sediment are stored; LOSS_SHARE.
// Needs: nothing. Filled by physical/cloud_pass.py, where the same members are declared.
// A thick cloud in the light of a lamp is as bright as one of the optical depth 1 / LOSS_SHARE whose light is scattered once.
#define LOSS_SHARE 0.1
layout(std140) uniform Clouds {
    vec4 cloud_layers;  // x: first range [m]; y: step from layer to layer [m]
    vec4 cloud_colour;  // rgb: albedo of a thick cloud in daylight
};
`;var Lc=`// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
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
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    float seen = 1.0 - min(particles.a, 1.0);
#else
    const float seen = 1.0;
#endif
#ifdef SHAFTS
    light += seen * textureLod(shaft_image, gl_FragCoord.xy / (float(SHAFTS) * vec2(textureSize(shaft_image, 0))), 0.0).rgb;
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
    excess *= seen;
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    vec3 scattered = textureLod(level_0, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_0, 0))), 0.0).rgb;
#ifdef PARTICLES
    // what dark surfaces take from the water is behind the particles; the veil is mostly in front of them
    scattered = max(scattered, 0.0) + seen * min(scattered, 0.0);
#endif
    light += scattered;
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
`;var Ic=`// Provides: the block Frame: values that are constant in an image.
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
`;var kc=`// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1).
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
`;var Fc=`// Provides: camera_colour(colour), the colour of a pixel in the image of a colour or grey camera.
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
`;var Cc=`// Provides: the block Instance: the pose of one instance in the camera frame, and its id.
// Needs: nothing. Filled by instance.py, where the same members are declared.
// camera_normals is the inverse transpose of camera_from_model (scale may be uneven).
layout(std140) uniform Instance {
    mat4 camera_from_model;
    mat4 camera_normals;
    uvec4 identity;  // x: id, 1..65535
};
`;var Nc=`// Provides: the radiance of a lamp that the camera sees, and its range.
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
`;var Oc=`// Provides: a point of 3 x 3 pixels where the camera sees a lamp.
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
`;var Dc=`// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
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
`;var Uc=`// Provides: lamplight(colour, unit_normal), the light of the lamps that a surface reflects.
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
`;var Vc=`// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, the number of lamps, 1..4. Filled by lamps.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to homogeneous texture coordinates and depth in the shadow maps
    vec4[4] lamp_position;     // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: opposite to the beam; w: factor from cosines inside the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var Bc=`// Provides: light shafts: what the waves add to the sun's light that the water scatters into the camera, or take from it.
// Needs: frame.glsl, optics.glsl, caustics_block.glsl, caustics.glsl with MAP_LEVEL; the image of the surfaces; the switches
// RATIO, the edge of a texel in pixels, N_STEPS, and MAP_PERCENT, the edge of a mean of the map in percent of a step.
// b pi E_b / mu p(Theta) integral of exp(-c* t) (G - 1) over the way t in water: caustics/light_shafts.py.
#include "frame.glsl"
#include "optics.glsl"
#include "caustics_block.glsl"
#include "caustics.glsl"
uniform sampler2D surface_image;
out vec4 colour_out;

void main() {
    vec2 pixel = float(RATIO) * gl_FragCoord.xy;
    ivec2 last = textureSize(surface_image, 0) - 1;
    float range = texelFetch(surface_image, min(ivec2(pixel), last), 0).a;
    vec3 ray = ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz;
    float unit = inversesqrt(dot(ray, ray));
    ray *= unit;
    float depth = -up.w;
    float rise = dot(ray, up.xyz);
    vec3 loss = sun_loss.rgb * upwelling.w;  // c*
    float length = min(range, shaft_numbers.z);
    float surface_range = depth / max(rise, 1e-4);
    float ratio = rise > 0.0 && range > 0.8 * surface_range ? caustic_loss.w : 3.0;  // a body hides the sun's aureole
    if (rise > 0.0) length = min(length, surface_range);
    if (depth <= 0.0 || length <= 0.0) {
        colour_out = vec4(0.0);
        return;
    }
    vec2 start = vec2(caustic_x.w, caustic_y.w);
    vec2 drift = vec2(dot(ray, caustic_x.xyz), dot(ray, caustic_y.xyz));
    float step_texels = sqrt(dot(drift, drift)) * shaft_numbers.w;  // for each metre
    float pixel_texels = float(RATIO) * ray_column.x * unit * swell_frame.w * shaft_numbers.w;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < N_STEPS; ++i) {
        float share = (float(i) + 0.5) / float(N_STEPS);
        float way = length * share * share;
        float width = length * share * (2.0 / float(N_STEPS));
        float map_level = log2(max(max(0.01 * float(MAP_PERCENT) * step_texels * width, pixel_texels * way), 1.0));
        float sample_depth = depth - rise * way;
        float excess = caustic_excess(start + drift * way, sample_depth, caustic_depths, swell_frame, map_level);
        sum += exp(loss * -way - (sun_loss.rgb + caustic_loss.rgb) * max(sample_depth, 0.0)) * (excess * width);
    }
    float cosine = dot(ray, sun.xyz);
    float q = sqrt(sqrt(max(0.5 - 0.5 * cosine, 1e-4)));
    vec4 high = phase_high;
    vec4 low = phase_low;
    float log_phase = ((high.w * q + high.z) * q + high.y) * q + high.x;
    log_phase = (((log_phase * q + low.w) * q + low.z) * q + low.y) * q + low.x;
    float g = shaft_numbers.x;
    float root = sqrt(max(1.0 + g * g - 2.0 * g * cosine, 1e-6));
    float scaled_phase = shaft_numbers.y * (1.0 - g * g) / (12.566371 * root * root * root);  // p* b* / b
    float phase = min(exp(log_phase), ratio * scaled_phase);
    colour_out = vec4(sun_beam.rgb * scattering.rgb * sum * (phase * 3.1415927 / upwelling.w), 0.0);
}
`;var zc=`// Provides: with NORMAL_MAP, mapped_normal(unit_normal); with MICROFACET, prepare_material, material_daylight, reflected_share.
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
`;var Gc=`// Provides: open_water(pixel, size), the radiance of open water behind a pixel; pixel counts as gl_FragCoord does.
// Needs: the small texture of physical/open_water_map.py.
// Its outer texels are at the image's corners.
uniform sampler2D open_water_map;

vec3 open_water(vec2 pixel, vec2 size) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return textureLod(open_water_map, (pixel / size * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
}
`;var Wc=`// Provides: the block Optics, the numbers of physical water; and FAR, the range of pixels without a surface.
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
`;var Hc=`// Provides: projected(dry, colour, unit_normal), the light of a surface with the projected pattern.
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
`;var Yc=`// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to homogeneous texture coordinates and depth in the shadow map
    vec4 projector_position;     // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: opposite to the beam; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var qc=`// Provides: the levels of blur after the second, each at half the resolution: texels weighed by 1, 3, 3, 1 along rows and columns.
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
`;var Xc=`// Provides: the light that levels of blur scatter, w_l (J - B), before their Gaussians.
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
`;var jc=`// Provides: one triangle over the whole target, without depth.
// Needs: nothing; three vertices without attributes.
// For the passes of physical water that work on whole images.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var Kc=`// Provides: depth only, which the rasteriser writes.
// Needs: with ALPHA_TEST, the alpha of holes, 1..255 of 255, a texture of the base colour.
// For all shadow maps.
#ifdef ALPHA_TEST
uniform sampler2D base_map;
in vec2 v_uv;
#endif

void main() {
#ifdef ALPHA_TEST
    if (texture(base_map, v_uv).a < float(ALPHA_TEST) / 255.0) discard;
#endif
}
`;var $c=`// Provides: sun_share(map_point), 0 in the sun's shadow to 1 in full sunlight.
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
`;var Qc=`// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector. With ALPHA_TEST, it has holes.
#include "instance.glsl"

in vec3 vertex;
#ifdef ALPHA_TEST
in vec2 uv;
out vec2 v_uv;
#endif

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
#ifdef ALPHA_TEST
    v_uv = uv;
#endif
}
`;var Jc=`// Provides: sunlit(colour, facing, mirrored, lit), the sunlight and ambient light that a surface reflects.
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
`;var Zc=`// Provides: colour, range and id of a surface seen through water, whichever are requested.
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
`;var ef=`// Provides: the vertices of a model, in the camera frame and on the image.
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
`;var tf=`// Provides: the requested outputs; the switches COLOUR, RANGE and IDS are their locations, or undefined.
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
`;var rf=`// Provides: direct(range) and whole_field(range), shares of light that arrives; weight(row, range), a share of scattered light.
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
`;var sf=`// Provides: the varyings of a surface; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
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
`;var nf=`// Provides: through_water(lit, range, fog_range, depth), the colour of a surface at the camera.
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
`;var of=`// Provides: coverage D (J - B) of a particle, and its coverage as alpha; the renderer draws it over those behind.
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
`;var af=`// Provides: the rectangle around the image of a particle, and the particle's radiance.
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
`;var lf=`// Provides: the block ParticleLens, the lens through which particles are seen.
// Needs: nothing. Filled by physical/particle_pass.py, where the same members are declared.
// A lens with the aperture A, focused at the distance F, blurs a point at r by A |1/r - 1/F|.
layout(std140) uniform ParticleLens {
    vec4 particle_lens;  // x: radius of the aperture [m]; y: 1 / distance of the focus [1/m]; z: least radius of an image [px]
};
`;var cf=`// Provides: the image of surfaces, radiance and range in water, without the water's surface: bodies, and the sky above it.
// Needs: optics.glsl, surface_block.glsl, waves.glsl, sky.glsl; the image of the surfaces, whose alpha is the whole range.
// Pixels that begin in air have the range 0 in water; the sea follows in water_surface.frag.glsl.
#include "optics.glsl"
#include "surface_block.glsl"
#include "waves.glsl"
#include "sky.glsl"
uniform sampler2D surface_image;
out vec4 light_out;

void main() {
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    vec3 ray = mat3(world_from_ray) * (ray_first.xyz + gl_FragCoord.x * ray_column.xyz + gl_FragCoord.y * ray_row.xyz);
    float height = eye.x + eye.y * ray.z;
#ifdef WAVES
    float variance;
    if (abs(height) < bounds.x) height -= waves_at(eye.y * ray.xy, 0.0, variance).x;
#endif
    light_out = texel;
    if (height <= 0.0) return;
    vec3 direction = normalize(ray);
    vec3 light = texel.a < 0.5 * FAR ? through_air(texel.rgb, direction, texel.a) : sky_in(direction) + sun_in(direction, 0.0);
    light_out = vec4(light, 0.0);
}
`;var ff=`// Provides: reflectance(cosine, sine_ratio), the share of unpolarised light that the surface reflects.
// Needs: nothing; cosine of incidence; sine_ratio = sine of refraction over sine of incidence: 1 / n from air, n from water.
// 1 where the light is totally reflected.
float reflectance(float cosine, float sine_ratio) {
    float squared = 1.0 - sine_ratio * sine_ratio * (1.0 - cosine * cosine);
    if (squared <= 0.0) return 1.0;
    float refracted = sqrt(squared);
    float s = (sine_ratio * cosine - refracted) / (sine_ratio * cosine + refracted);
    float p = (cosine - sine_ratio * refracted) / (cosine + sine_ratio * refracted);
    return 0.5 * (s * s + p * p);
}
`;var uf=`// Provides: sky_in(direction), the sky without the sun; sun_in(direction, variance); water_in(direction); through_air(light, direction, range).
// Needs: surface_block.glsl; the hemispheres of surface/hemispheres.py. Directions are unit vectors in W.
// sun_in: the sun's image with a blur of that variance along each axis [rad2]; water_in: the open water below the surface.
uniform sampler2DArray hemispheres;

vec3 hemisphere(vec3 direction, float layer) {
    vec2 place = direction.xy / (1.0 + max(direction.z, 0.0));
    float size = float(textureSize(hemispheres, 0).x);
    return textureLod(hemispheres, vec3((place * (size - 1.0) / size) * 0.5 + 0.5, layer), 0.0).rgb;
}

vec3 sky_in(vec3 direction) {
    return hemisphere(direction.z < 0.0 ? vec3(direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-12)), 0.0) : direction, 0.0);
}

vec3 water_in(vec3 direction) {
    return hemisphere(vec3(direction.xy, -direction.z), 1.0);
}

vec3 sun_in(vec3 direction, float variance) {
    float total = variance + 0.25 * sky_sun.w * sky_sun.w + 0.25 * air.z * air.z;
    vec3 apart = direction - sky_sun.xyz;
    return sky_sun_light.rgb * (0.5 / total * exp(-0.5 * dot(apart, apart) / total));
}

vec3 through_air(vec3 light, vec3 direction, float range) {
    return mix(sky_in(vec3(direction.xy, -1.0)), light, exp(-air.x * range));
}
`;var hf=`// Provides: skylight(normal, share), the light of sun and sky on a surface in air, and of the sea below it.
// Needs: surface_block.glsl; the unit normal in the camera frame; share = 0 in the sun's shadow to 1.
// The sky and the sea count as even; the sea reflects 6 % of the light.
vec3 skylight(vec3 normal, float share) {
    vec3 upright = mat3(world_from_ray) * normal;
    vec3 level = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
    return sky_sun_light.rgb * (max(dot(upright, sky_sun.xyz), 0.0) * share)
        + sky_light.rgb * (0.5 + 0.5 * upright.z) + level * (0.03 - 0.03 * upright.z);
}
`;var mf=`// Provides: the block Surface, the numbers of the water's surface, the sky and the air.
// Needs: nothing. Filled by surface/surface_block.py, where the same members are declared.
// Offsets are positions in W minus that of the camera [m].
layout(std140) uniform Surface {
    mat4 clip_from_offset;
    mat4 world_from_ray;   // rotation: W from the camera frame (OpenGL axes)
    vec4 eye;              // x: height of the camera above the still surface [m]; y: near plane [m]; w: number of grids
    vec4[4] grids;         // for each grid: xy: texture coordinates of the camera; z: 1 / edge [1/m]; w: spacing [m]
    vec4 roughness;        // variance of the slopes that each grid leaves out
    vec4 ripples;          // x: factor on the slopes of a tile; y: their variance; z: 1 / edge of the tile [1/m]; w: its spacing [m]
    vec4 ripple_origin;    // xy: camera in the tile [m]
    vec4 ripple_turn;      // xy: camera in the turned, smaller tile [m]; zw: cosine and sine of its turn over its size
    vec4 bounds;           // x: greatest elevation of waves [m]; y: variance of their slopes along one axis
    vec4 sky_sun;          // xyz: towards the sun above the water, W; w: its angular radius [rad]
    vec4 sky_sun_light;    // rgb: irradiance of a surface that faces the sun; w: cosine of the refracted sun from the zenith
    vec4 sky_light;        // rgb: irradiance of a level surface by the sky
    vec4 water_light;      // rgb: radiance of the open water from below the surface, even
    vec4 image_size;       // xy: width and height [px]
    vec4 air;              // x: attenuation of air [1/m]; y: refractive index of water; z: angle of a pixel [rad]
};
`;var df=`// Provides: numbers of the block Surface as flat varyings; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: surface_block.glsl; the switches WAVES, RIPPLES and FOAM. In the fragment shader, include it before waves.glsl and sky.glsl:
// their names of members of the block then are these varyings. llvmpipe reads them much faster than uniforms in each pixel.
flat VARYING vec4 v_air;
flat VARYING vec4 v_sky_sun;
flat VARYING vec4 v_sky_sun_light;
flat VARYING vec4 v_water_light;
#if defined(WAVES) && WAVES == 1
flat VARYING vec4[1] v_grids;
flat VARYING vec4 v_roughness;
#endif
#ifdef RIPPLES
flat VARYING vec4 v_ripples;
flat VARYING vec4 v_ripple_origin;
flat VARYING vec4 v_ripple_turn;
#endif
#ifdef FOAM
flat VARYING vec4 v_sky_light;
#endif
#ifdef READS_VARYINGS
#define air v_air
#define sky_sun v_sky_sun
#define sky_sun_light v_sky_sun_light
#define water_light v_water_light
#if defined(WAVES) && WAVES == 1
#define grids v_grids
#define roughness v_roughness
#endif
#define ripples v_ripples
#define ripple_origin v_ripple_origin
#define ripple_turn v_ripple_turn
#define sky_light v_sky_light
#else
void pass_on_surface() {
    v_air = air;
    v_sky_sun = sky_sun;
    v_sky_sun_light = sky_sun_light;
    v_water_light = water_light;
#if defined(WAVES) && WAVES == 1
    v_grids[0] = grids[0];
    v_roughness = roughness;
#endif
#ifdef RIPPLES
    v_ripples = ripples;
    v_ripple_origin = ripple_origin;
    v_ripple_turn = ripple_turn;
#endif
#ifdef FOAM
    v_sky_light = sky_light;
#endif
}
#endif
`;var pf=`// Provides: the radiance and the range in water of the water's surface, from below, or with the switch ABOVE from above.
// Needs: optics.glsl, surface_block.glsl, surface_varyings.glsl, waves.glsl, sky.glsl, fresnel.glsl; transmission.glsl from above;
// without the switch DIRECT, the image of the surfaces, whose alpha is the whole range; the switch BODIES_ABOVE if one may be mirrored.
// From below: sky refracted, open water reflected; the water before it follows in whole images (physical/development.py), which
// takes the open water B behind it away. From above: sky reflected, the water and the bodies in it refracted. See surface_pass.py.
#include "optics.glsl"
#include "surface_block.glsl"
#define VARYING in
#define READS_VARYINGS
#include "surface_varyings.glsl"
#include "waves.glsl"
#include "sky.glsl"
#include "fresnel.glsl"
#ifdef ABOVE
#include "transmission.glsl"
#endif
#ifndef DIRECT
uniform sampler2D surface_image;
#endif
in vec3 v_offset;
#ifndef ABOVE
in vec3 v_open_water;
#endif
out vec4 light_out;
const float PI = 3.14159265;
#ifdef FOAM
const float FOAM_START = 0.35;  // downward acceleration over gravity: surface/surface_pass.py
const float FOAM_END = 0.5;
#endif

#ifdef ABOVE
// Follow a ray from a point of the surface within the picture to a body above (side 1) or below (side -1) the still surface: six
// distances, each 2.2 times the one before, then two halvings. Return the way to the body, or 0; seen is its pixel. Below, the border of the picture is continued.
float follow(vec3 direction, float side, float range, ivec2 size, out vec4 seen) {
    vec4 here = clip_from_offset * vec4(v_offset, 1.0);
    vec4 change = clip_from_offset * vec4(direction, 0.0);
    float first = 0.0;
    float way = 0.25 / max(abs(direction.z), 0.1);
    float met = 0.0;
    ivec2 pixel = ivec2(0);
    for (int i = 0; i < 8; ++i) {
        vec4 clip = here + way * change;
        vec2 place = clip.xy / clip.w * 0.5 + 0.5;
        if (side > 0.0 && (clip.w <= 0.0 || place != clamp(place, 0.0, 1.0))) break;  // it does not come back
        ivec2 there = ivec2(clamp(place, 0.0, 0.9999) * vec2(size));
        float body_range = texelFetch(surface_image, there, 0).a;
        vec3 offset = v_offset + way * direction;
        float distance = length(offset);
        bool is_seen = clip.w > 0.0 && body_range > range * (0.5 - 0.5 * side)
            && body_range < distance && body_range > distance - max(way, 1.0) && side * (eye.x + offset.z * body_range / distance) > 0.0;
        if (is_seen) {
            met = way;
            pixel = there;
        }
        if (met > 0.0) {
            if (!is_seen) first = way;
            way = 0.5 * (first + met);
            if (i >= 7) break;
        } else {
            first = way;
            if (i >= 5) break;
            way *= 2.2;
        }
    }
    seen = met > 0.0 ? texelFetch(surface_image, pixel, 0) : vec4(0.0);
    return met;
}

vec3 light_above(vec3 towards, float range, vec3 normal, float variance, ivec2 size) {
    float cosine = max(-dot(towards, normal), 0.0);
    float share = reflectance(sqrt(min(cosine * cosine + 0.5 * variance, 1.0)), 1.0 / air.y);
    vec3 mirrored = reflect(towards, normal);
    mirrored = normalize(vec3(mirrored.xy, abs(mirrored.z) + 0.5 * sqrt(variance)));
    vec4 seen;
    vec3 above = sky_in(mirrored);
#ifdef BODIES_ABOVE
    if (follow(mirrored, 1.0, range, size, seen) > 0.0) above = seen.rgb;
#endif
    vec3 light = share * above;
    vec3 half_way = normalize(sky_sun.xyz - towards);
    float steep = max(half_way.z, 0.05);
    float spread = variance + 0.0625 * sky_sun.w * sky_sun.w + 0.0625 * air.z * air.z;
    vec2 apart = half_way.xy / -steep - normal.xy / -normal.z;
    float facets = exp(-0.5 * dot(apart, apart) / spread) / (2.0 * PI * spread);
    float glint = reflectance(max(-dot(half_way, towards), 0.0), 1.0 / air.y) * PI * facets;
    light += sky_sun_light.rgb * (glint / (4.0 * max(cosine, 0.05) * steep * steep * steep * steep));
    vec3 refracted = refract(towards, normal, 1.0 / air.y);
    vec3 below = water_in(refracted);
    float met = follow(refracted, -1.0, range, size, seen);
    if (met > 0.0) below = mix(below, seen.rgb, whole_field(met));
    return light + (1.0 - share) / (air.y * air.y) * below;
}

#else
// In the window the open water that is reflected counts as even, so one look-up is enough.
vec3 light_below(vec3 towards, vec3 normal, float variance) {
    float cosine = clamp(dot(towards, normal), 1e-3, 1.0);
    float share = reflectance(cosine, air.y);
    vec3 refracted = refract(towards, -normal, air.y);
    vec3 mirrored = reflect(towards, normal);
    bool is_window = share < 1.0;
    vec3 direction = is_window ? vec3(refracted.xy, max(refracted.z, 0.0)) : vec3(mirrored.xy, abs(mirrored.z));
    vec3 light = hemisphere(direction, is_window ? 0.0 : 1.0);
    if (!is_window) return light;
    float slant = dot(refracted, normal);
    float turn = (air.y * cosine - slant) / max(slant, 0.15);
    light += sun_in(refracted, turn * turn * variance + 0.5 * air.z * air.z);
    return (1.0 - share) * air.y * air.y * light + share * water_light.rgb;
}
#endif

void main() {
    float range = length(v_offset);
#ifndef DIRECT
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    if (texel.a < range) discard;
#endif
    vec3 towards = v_offset / range;
    float variance;
    float footprint = range * air.z / clamp(abs(towards.z), 0.02, 1.0);
    vec4 wave = waves_at(v_offset.xy, footprint, variance);
    vec2 slope = wave.yz;
#ifdef RIPPLES
    slope += add_ripples(v_offset.xy, footprint, variance);
#endif
    vec3 normal = normalize(vec3(-slope, 1.0));
#ifdef FOAM
    float streaks = 0.0;
#ifdef RIPPLES
    streaks = foam_pattern(v_offset.xy, footprint);
#endif
    float foam = 0.9 * smoothstep(FOAM_START, FOAM_END, wave.w + streaks);
    vec3 lit = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
#endif
#ifdef ABOVE
    vec3 light = light_above(towards, range, normal, variance, textureSize(surface_image, 0));
#ifdef FOAM
    light = mix(light, 0.5 * lit, foam);
#endif
    light_out = vec4(through_air(light, towards, range), 0.0);
#else
    vec3 light = light_below(towards, normal, variance);
#ifdef FOAM
    light = mix(light, 0.3 * lit, foam);
#endif
    light_out = vec4(light + v_open_water, range);
#endif
}
`;var gf=`// Provides: the water's surface around the camera, raised by the waves.
// Needs: surface_block.glsl, surface_varyings.glsl, waves.glsl, open_water.glsl without the switch ABOVE; vertices are offsets from the camera in the horizontal plane of W [m].
// The far plane is at infinity; with the switch DIRECT it is that of the camera.
#include "surface_block.glsl"
#define VARYING out
#include "surface_varyings.glsl"
#include "waves.glsl"
#ifndef ABOVE
#include "open_water.glsl"
out vec3 v_open_water;  // behind the surface; even enough to be interpolated
#endif
in vec2 vertex;
out vec3 v_offset;

void main() {
    pass_on_surface();
    float variance;
    v_offset = vec3(vertex, waves_at(vertex, 0.0, variance).x - eye.x);
    gl_Position = clip_from_offset * vec4(v_offset, 1.0);
#ifndef ABOVE
    vec2 place = gl_Position.xy / max(gl_Position.w, 1e-3) * 0.5 + 0.5;
    v_open_water = open_water(clamp(place, 0.0, 1.0) * image_size.xy, image_size.xy);
#endif
#ifndef DIRECT
    gl_Position.z = gl_Position.w - 2.0 * eye.y;
#endif
}
`;var vf=`// Provides: waves_at(offset, footprint, variance), the waves of the surface; add_ripples(...), the slopes of ripples.
// Needs: surface_block.glsl; the switches WAVES, the number of grids, and RIPPLES; the grids of surface/wave_grids.py and the tile of surface/ripples.py.
// offset: from the camera in the horizontal plane of W [m]; footprint: length of a pixel on the surface [m]; variance of the
// slopes along one axis that the pixel does not resolve. Finer grids go over into coarser ones without a seam.
#ifdef WAVES
#if WAVES == 1
uniform sampler2D wave_grid;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grid, grids[0].xy + offset * grids[0].z, 0.0);
}
#else
uniform sampler2DArray wave_grids;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grids, vec3(grids[level].xy + offset * grids[level].z, float(level)), 0.0);
}
#endif
#endif
#ifdef RIPPLES
uniform sampler2D ripple_tile;
#endif

// Elevation [m], slopes along x and y, downward acceleration over gravity.
vec4 waves_at(vec2 offset, float footprint, out float variance) {
    variance = 0.0;
    vec4 wave = vec4(0.0);
#if defined(WAVES) && WAVES == 1
    variance = roughness[0];
    wave = grid_at(0, offset);
#elif defined(WAVES)
    float distance = max(abs(offset.x), abs(offset.y)) * grids[0].z / 0.46;
    float coarse = 0.5 * log2(max(footprint / grids[0].w, 1e-6));
    float level = max(max(0.5 * log2(max(distance, 1e-6)) + 1.0, min(coarse, eye.w - 1.0)), 0.0);
    float share = smoothstep(0.5, 1.0, fract(level));
    int finer = int(level);
    int n = int(eye.w);
    variance = bounds.y;
    if (finer < n) {
        wave = grid_at(finer, offset);
        variance = roughness[finer];
    }
    if (share > 0.0) {
        wave *= 1.0 - share;
        variance *= 1.0 - share;
        if (finer + 1 < n) {
            wave += share * grid_at(finer + 1, offset);
            variance += share * roughness[finer + 1];
        } else {
            variance += share * bounds.y;
        }
    }
#endif
    return wave;
}

#ifdef RIPPLES
float tile_fade(float footprint, inout float variance) {
    float fade = 1.0 - smoothstep(3.0, 12.0, footprint / ripples.w);
    variance += ripples.y * (1.0 - fade * fade);
    return ripples.x * fade;
}

vec2 add_ripples(vec2 offset, float footprint, inout float variance) {
    mat2 turn = mat2(ripple_turn.z, ripple_turn.w, -ripple_turn.w, ripple_turn.z);
    float stretch = length(ripple_turn.zw);
    vec2 shift = vec2(0.5 / 128.0);
    vec2 slope = textureLod(ripple_tile, (ripple_origin.xy + offset) * ripples.z + shift, 0.0).yz;
    vec2 turned = textureLod(ripple_tile, (ripple_turn.xy + turn * offset) * ripples.z + shift, 0.0).yz;
    return tile_fade(footprint, variance) * slope + tile_fade(footprint * stretch, variance) / stretch * (transpose(turn) * turned);
}

// An irregular pattern of -0.1 to 0.1 for foam, by the tile and by one five times as large.
float foam_pattern(vec2 offset, float footprint) {
    vec2 place = (ripple_origin.xy + offset) * ripples.z;
    vec2 wide = textureLod(ripple_tile, place * 0.2, 0.0).yz;
    vec2 small = textureLod(ripple_tile, place, 0.0).yz;
    float fade = 1.0 - smoothstep(3.0, 12.0, footprint / ripples.w);
    return clamp(0.07 * (wide.x + wide.y * wide.x) + (0.06 * fade) * (small.x + small.y * small.x), -0.1, 0.1);
}
#endif
`;var yf=`// Provides: a finished image at its place on the page; an image twice as wide and high becomes the mean of its squares of four.
// Needs: presented.vert.glsl; the image, row 0 at the top, with linear interpolation.
in vec2 v_uv;
uniform sampler2D level_0;
out vec4 colour_out;

void main() {
    colour_out = textureLod(level_0, v_uv, 0.0);
}
`;var _f=`// Provides: one triangle over the whole target, and the texture coordinates of its pixels.
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
`;var bf=`// Provides: the waves at the points of a grid: elevation [m], slopes along x and y, downward acceleration over gravity.
// Needs: screen.vert.glsl; the factors of each component at the columns and at the rows of the grid (wave_grids.ts).
uniform sampler2D factors_x;  // cosine and sine of the phase; wave number along x [rad/m]; squared frequency over gravity [1/m]
uniform sampler2D factors_y;  // amplitude [m] times cosine and sine of the change of phase; wave number along y
out vec4 grid_out;

void main() {
    ivec2 point = ivec2(gl_FragCoord.xy);
    int n = textureSize(factors_x, 0).y;
    vec4 total = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec4 x = texelFetch(factors_x, ivec2(point.x, i), 0);
        vec4 y = texelFetch(factors_y, ivec2(point.y, i), 0);
        float height = y.x * x.x - y.y * x.y;
        float steepness = y.x * x.y + y.y * x.x;
        total += vec4(height, -x.z * steepness, -y.z * steepness, x.w * height);
    }
    grid_out = total;
}
`;var Wp={"background.frag.glsl":_c,"background.vert.glsl":bc,"blurred.frag.glsl":wc,"blurred_rows.frag.glsl":xc,"caustics.glsl":Ec,"caustics_block.glsl":Ac,"cloud.frag.glsl":Mc,"cloud.vert.glsl":Tc,"cloud_edge.glsl":Rc,"clouds.glsl":Pc,"daylight.glsl":Sc,"developed.frag.glsl":Lc,"frame.glsl":Ic,"gaussian.glsl":kc,"grey.glsl":Fc,"instance.glsl":Cc,"lamp_point.frag.glsl":Nc,"lamp_point.vert.glsl":Oc,"lamp_veil.glsl":Dc,"lamplight.glsl":Uc,"lamps.glsl":Vc,"light_shafts.frag.glsl":Bc,"material.glsl":zc,"open_water.glsl":Gc,"optics.glsl":Wc,"particle.frag.glsl":of,"particle.vert.glsl":af,"particle_lens.glsl":lf,"presented.frag.glsl":yf,"presented.vert.glsl":_f,"projection.glsl":Hc,"projector.glsl":Yc,"reduced.frag.glsl":qc,"scattered.frag.glsl":Xc,"screen.vert.glsl":jc,"shadow.frag.glsl":Kc,"shadow.glsl":$c,"shadow.vert.glsl":Qc,"sun.glsl":Jc,"surface.frag.glsl":Zc,"surface.vert.glsl":ef,"targets.glsl":tf,"transmission.glsl":rf,"varyings.glsl":sf,"water.glsl":nf,"air.frag.glsl":cf,"fresnel.glsl":ff,"sky.glsl":uf,"skylight.glsl":hf,"surface_block.glsl":mf,"surface_varyings.glsl":df,"water_surface.frag.glsl":pf,"water_surface.vert.glsl":gf,"waves.glsl":vf,"wave_grid.frag.glsl":bf},Hp=`#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DShadow;
#define noperspective
`,jt={Frame:0,Instance:1,Lamps:2,Projector:3,Optics:4,Caustics:5,Surface:7,ParticleLens:9,Clouds:10},J={base_map:0,shadow_map:1,lamp_maps:2,projector_map:3,projector_pattern:4,open_water_map:5,weight_table:6,level_0:7,level_1:8,level_2:9,level_3:10,level_4:15,level_5:16,surface_image:17,normal_map:11,finish_map:12,emission_map:13,reflectance_table:14,particle_image:18,wave_grids:19,wave_grid:20,ripple_tile:21,hemispheres:22,factors_x:23,factors_y:24,cloud_layers_map:25,cloud_lamplight_map:26,cloud_daylight_map:27,caustic_maps:28,swell_map:29,shaft_image:30},Ft={vertex:0,vertex_normal:1,uv:2,tint:3,tangent:4,finish:5,emission:6,place:8,extent:9,traits:10,depth:11},Ri=class{constructor(e){this.gl=e}gl;programs=new Map;get(e,t,r=e){let i=e+JSON.stringify(t),n=this.programs.get(i);return n||this.programs.set(i,n=Yp(this.gl,e,t,r)),n}};function wf(s,e){if(e.has(s))return"";e.add(s);let t=Wp[s];return t===void 0?`#error no shader file ${s}`:t.replace(/^#include "([\w.]+)"$/gm,(r,i)=>wf(i,e))}function Yp(s,e,t,r){let i=Object.entries(t).map(([o,a])=>`#define ${o} ${a}
`),n=s.createProgram();for(let[o,a]of[[s.VERTEX_SHADER,`${r}.vert.glsl`],[s.FRAGMENT_SHADER,`${e}.frag.glsl`]]){let l=s.createShader(o);s.shaderSource(l,Hp+i.join("")+wf(a,new Set)),s.compileShader(l),s.attachShader(n,l)}for(let[o,a]of Object.entries(Ft))s.bindAttribLocation(n,a,o);if(s.linkProgram(n),!s.getProgramParameter(n,s.LINK_STATUS)){let o=(s.getAttachedShaders(n)??[]).map(a=>s.getShaderInfoLog(a));throw new Error(`${e}: ${s.getProgramInfoLog(n)} ${o.join(" ")}`)}s.useProgram(n);for(let[o,a]of Object.entries(jt)){let l=s.getUniformBlockIndex(n,o);l!==s.INVALID_INDEX&&s.uniformBlockBinding(n,l,a)}for(let[o,a]of Object.entries(J))s.uniform1i(s.getUniformLocation(n,o),a);return n}var xf={normal_map:"NORMAL_MAP",finish_map:"FINISH_MAP",emission_map:"EMISSION_MAP"},Ef=32,qp=[["tangent","tangents",4,"SHORT"],["finish","finish",3,"FLOAT"],["emission","emissions",3,"FLOAT"]];function Xp(s,e,t){let r={};return"normal_map"in s.maps&&(r.NORMAL_MAP=1),e&&(r.MICROFACET=1,"finish_map"in s.maps&&(r.FINISH_MAP=1),s.emits&&(r.EMISSION=1),s.emits&&"emission_map"in s.maps&&(r.EMISSION_MAP=1)),t&&s.cutoff!==null&&(r.ALPHA_TEST=Math.max(1,Math.min(255,Math.round(255*s.cutoff)))),r}function Af(s,e){for(let[t,r,i,n]of qp){let o=s[r];o&&e(t,i,n,o)}}var Pi=class{constructor(e,t,r,i){this.gl=e;this.images=r;this.textures=i;this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(o=>{let a=e.createSampler();return e.samplerParameteri(a,e.TEXTURE_MIN_FILTER,e.LINEAR_MIPMAP_NEAREST),e.samplerParameteri(a,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_WRAP_S,o),e.samplerParameteri(a,e.TEXTURE_WRAP_T,o),a});let{reflectance:n}=t.head;this.table=n?jp(e,t.numbers(n)):null}gl;images;textures;samplers;table;use(e,t,r){if(!e)return t;let i=this.gl,n={...t,...Xp(e,"PHYSICAL"in t,"TEXTURED"in t)};for(let[o,a]of Object.entries(e.maps)){if(!(xf[o]in n))continue;let l=Number(this.textures[a].repeats);this.bindTexture(J[o],this.images[a]),i.bindSampler(J[o],(r??this.samplers)[l])}return n.MICROFACET&&this.table&&this.bindTexture(J.reflectance_table,this.table),n}release(){for(let e of Object.keys(xf))this.gl.bindSampler(J[e],null)}bindTexture(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}};function jp(s,e){let t=s.createTexture();s.bindTexture(s.TEXTURE_2D,t),s.texImage2D(s.TEXTURE_2D,0,s.RGBA16F,Ef,Ef,0,s.RGBA,s.FLOAT,e);for(let r of[s.TEXTURE_WRAP_S,s.TEXTURE_WRAP_T])s.texParameteri(s.TEXTURE_2D,r,s.CLAMP_TO_EDGE);for(let r of[s.TEXTURE_MIN_FILTER,s.TEXTURE_MAG_FILTER])s.texParameteri(s.TEXTURE_2D,r,s.LINEAR);return t}var Ao=class{constructor(e,t,r,i,n,o,a,l){this.index=e;this.visual=t;this.body=r;this.vertexArray=i;this.texture=n;this.repeats=o;this.hasUint32Indices=a;this.pieceRows=l;this.bodyFromMesh=Se(t.matrix),this.pieces=l.map(([c,h])=>({instance:this,firstIndex:c,count:h,centre:[0,0,0],radius:0,corners:[],normal:[0,0,0],density:0}))}index;visual;body;vertexArray;texture;repeats;hasUint32Indices;pieceRows;pieces;worldFromMesh=Se(new Array(16).fill(0));normals=this.worldFromMesh;isMirrored=!1;bodyFromMesh;place(e){let t=Ie(e,this.bodyFromMesh);if(t.every((n,o)=>n===this.worldFromMesh[o]))return!1;this.worldFromMesh=t,this.normals=ya(t),this.isMirrored=Pn(t)<0;let[r,i]=[Sf(t),Sf(this.normals)];return this.pieceRows.forEach((n,o)=>{let a=this.pieces[o];a.centre=Re(t,n.slice(2,5)),a.radius=n[5]*r;let l=[n.slice(6,9),n.slice(9,12)];a.corners=[0,1,2,3,4,5,6,7].map(h=>Re(t,[l[h>>2][0],l[h>>1&1][1],l[h&1][2]]));let c=n.slice(12,15);a.normal=le(c,c)>0?wt(Xr(this.normals,c)):[0,0,0],a.density=n[15]*i}),!0}};function Sf(s){let e=[0,1,2].map(r=>[s[r],s[4+r],s[8+r]]),t=e.map(r=>e.reduce((i,n)=>i+Math.abs(le(r,n)),0));return Math.sqrt(Math.max(...t))}var Li=class s{constructor(e,t){this.head=e;this.gl=t}head;gl;instances=[];version=0;patterns=[];maps=null;bodies=new Map;radii=new Map;sand=[];static async load(e,t){let r=new s(t.head,e);if(r.place(new Map),!e)return r;let{meshes:i,textures:n,bodies:o,projector:a}=t.head,l=await Promise.all(n.map(({repeats:u},m)=>$p(e,t,m,m!==a?.pattern&&u)));a&&r.patterns.push(l[a.pattern]),r.maps=new Pi(e,t,l,n);let c=i.map((u,m)=>Kp(e,t,m)),h=c.map(({vertexArray:u})=>u);for(let u of t.head.sand??[]){let m=t.numbers(i[u.mesh].positions);r.sand.push({heap:new Ti(u,m),...c[u.mesh]})}for(let u of o)for(let m of u.visuals){let{texture:p,mesh:y}=m,_=p===null?null:l[p],w=p!==null&&n[p].repeats,E=i[y].triangles[2]==="u4",[x,M]=[r.instances.length,i[y].pieces];r.instances.push(new Ao(x,m,u.name,h[y],_,w,E,M))}return r.place(new Map),r}place(e){for(let r of this.head.bodies)this.bodies.set(r.name,e.get(r.name)??nt(r.pose));let t=!1;for(let r of this.instances)t=r.place(this.body(r.body))||t;t&&(this.version+=1,this.computeRadii())}setSand(e,t){let{gl:r}=this,{heap:i,positions:n,normals:o}=this.sand[e]??{};if(!r||!i||!n||!o||!(t instanceof Float32Array?i.set(t):i.apply(t)))return;let a=i.surface();r.bindBuffer(r.ARRAY_BUFFER,n),r.bufferData(r.ARRAY_BUFFER,a.positions,r.STATIC_DRAW),r.bindBuffer(r.ARRAY_BUFFER,o),r.bufferData(r.ARRAY_BUFFER,a.normals,r.STATIC_DRAW),this.version+=1}heights(e){return this.sand[e]?.heap.heights??new Float32Array}body(e){return this.bodies.get(e)??nt([0,0,0,1,0,0,0])}worldFromMount(e){let t=nt(e.pose);return e.body===null?t:Ie(this.body(e.body),t)}radius(e){return this.radii.get(e.visual.part)??0}computeRadii(){let e=new Map;for(let{visual:t,pieces:r}of this.instances){let i=e.get(t.part)??[1/0,1/0,1/0,-1/0,-1/0,-1/0];for(let{centre:n,radius:o}of r)for(let a=0;a<3;++a)i[a]=Math.min(i[a],n[a]-o),i[3+a]=Math.max(i[3+a],n[a]+o);e.set(t.part,i)}for(let[t,r]of e)this.radii.set(t,Math.max(r[3]-r[0],r[4]-r[1],r[5]-r[2])/2)}};function Kp(s,e,t){let r=e.head.meshes[t],i=s.createVertexArray();s.bindVertexArray(i);let n=(c,h,u,m)=>{let p=s.createBuffer();return s.bindBuffer(s.ARRAY_BUFFER,p),s.bufferData(s.ARRAY_BUFFER,m,s.STATIC_DRAW),s.enableVertexAttribArray(Ft[c]),s.vertexAttribPointer(Ft[c],h,u,u!==s.FLOAT,0,0),p},o=c=>e.numbers(c),a=n("vertex",3,s.FLOAT,o(r.positions)),l=n("vertex_normal",3,s.SHORT,o(r.normals));return n("tint",3,s.UNSIGNED_SHORT,o(r.tints)),r.uvs&&n("uv",2,s.FLOAT,o(r.uvs)),Af(r,(c,h,u,m)=>n(c,h,s[u],o(m))),s.bindBuffer(s.ELEMENT_ARRAY_BUFFER,s.createBuffer()),s.bufferData(s.ELEMENT_ARRAY_BUFFER,o(r.triangles),s.STATIC_DRAW),s.bindVertexArray(null),{vertexArray:i,positions:a,normals:l}}async function $p(s,e,t,r){let{type:i,bytes:n}=e.head.textures[t],o=t===e.head.projector?.pattern,a=await createImageBitmap(new Blob([e.numbers(n)],{type:i}),{imageOrientation:o?"from-image":"flipY",premultiplyAlpha:"none",colorSpaceConversion:"none"}),l=s.createTexture();s.bindTexture(s.TEXTURE_2D,l),s.texImage2D(s.TEXTURE_2D,0,s.RGBA8,s.RGBA,s.UNSIGNED_BYTE,a);let c=r?s.REPEAT:s.CLAMP_TO_EDGE;return s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_S,c),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_T,c),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MAG_FILTER,s.LINEAR),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MIN_FILTER,o?s.LINEAR:s.LINEAR_MIPMAP_LINEAR),o||s.generateMipmap(s.TEXTURE_2D),a.close(),l}var Qp=["#ff5a4f","#45d96b","#4aa3ff"],Ls=.02,Ps=11,Jp=[0,1,-1,2,-2,3,-3,4,-4,5,-5],So=class{constructor(e,t,r){this.context=e;this.intrinsics=r;this.cameraFromWorld=Ze(t)}context;intrinsics;labelBoxes=[];cameraFromWorld;line(e,t,r=1.5,i=[]){let{context:n}=this;n.strokeStyle=t,n.lineWidth=r,n.setLineDash(i),n.beginPath();let o=null;for(let a of e){let l=Re(this.cameraFromWorld,a);if(o&&(o[2]<-Ls||l[2]<-Ls)){let[c,h]=[Mf(o,l),Mf(l,o)];n.moveTo(...this.pixel(c)),n.lineTo(...this.pixel(h))}o=l}n.stroke()}project(e){let t=Re(this.cameraFromWorld,e);return t[2]<-Ls?this.pixel(t):null}label(e,t,r="#ffffff"){let i=this.project(e);if(!i)return;let{context:n}=this;n.font=`${Ps}px system-ui, sans-serif`;let o=this.findSpot(i,n.measureText(t).width);if(!o)return;let[a,l]=o;Math.abs(l-i[1])>2*Ps&&this.drawLeader(i,[a-2,l-Ps/3],r),n.lineWidth=3,n.setLineDash([]),n.strokeStyle="rgba(0, 12, 24, 0.75)",n.strokeText(t,a,l),n.fillStyle=r,n.fillText(t,a,l)}findSpot([e,t],r){for(let i of Jp)for(let n of[e+5,e-5-r]){let o=t-5+i*(Ps+3),a=[n-2,o-Ps,n+r+2,o+3];if(!this.labelBoxes.some(l=>a[0]<l[2]&&a[2]>l[0]&&a[1]<l[3]&&a[3]>l[1]))return this.labelBoxes.push(a),[n,o]}return null}drawLeader(e,t,r){let{context:i}=this;i.strokeStyle=r,i.lineWidth=.75,i.setLineDash([]),i.beginPath(),i.moveTo(...e),i.lineTo(...t),i.stroke()}dot(e,t,r){let i=this.project(e);i&&(this.context.fillStyle=t,this.context.beginPath(),this.context.arc(i[0],i[1],r,0,2*Math.PI),this.context.fill())}pixel([e,t,r]){let{fx:i,fy:n,cx:o,cy:a,skew:l}=this.intrinsics;return[o+(i*e+l*t)/-r+.5,a-n*t/-r+.5]}};function Mf(s,e){if(s[2]<-Ls)return s;let t=(-Ls-s[2])/(e[2]-s[2]);return s.map((r,i)=>r+t*(e[i]-r))}function Tf(s,e,t,r,i,n,o,a){let l=new So(s,e,t);for(let{name:c,at:h,colour:u,lines:m}of n.markers(o.time)){for(let p of m)l.line(p,u);m.length||l.dot(h,u,3),(a.labels||!m.length)&&l.label(h,c)}if(a.trails&&Zp(l,r,n,o),a.sonars)for(let c of r.sensors)tg(l,c,i.worldFromMount(c),o);if(a.frames)eg(l,r,i,a.labels);else if(a.labels)for(let{name:c,body:h}of r.vehicles)l.label(de(i.body(h)),c);for(let c of o.points("contacts",["x","y","z"]))l.dot(c,"#ffb02e",4);for(let{name:c,body:h}of r.vehicles)rg(l,c,i.body(h),o)}function Zp(s,e,t,r){let i=e.vehicles.map(({body:o})=>o),n=e.bodies.filter(o=>o.vehicle===null).map(({name:o})=>o);for(let o of[...i,...n]){let a=r.poses.get(o);if(!a)continue;let l=t.trail(o,r.time);s.line([...l,de(a)],"rgba(255, 214, 92, 0.9)",1.5)}}function eg(s,e,t,r){let i=e.vehicles.length>1,n=new Map(e.bodies.map(({name:o,vehicle:a})=>[o,a??""]));for(let{name:o,body:a,pose:l}of e.frames){let c=t.worldFromMount({body:a,pose:l}),h=a===null?1:.25;Qp.forEach((m,p)=>{let y=[0,1,2].map(_=>_===p?h:0);s.line([de(c),Re(c,y)],m,2)});let u=i&&a!==null?`${n.get(a)} `:"";r&&s.label(de(c),u+o.split("/").at(-1))}}function tg(s,e,t,r){let i="rgba(120, 220, 255, 0.8)",n=r.signal(`range/${e.name}`);if(e.kind==="range"){let l=n??e.reach,c=Re(t,[l,0,0]);s.line([de(t),c],i,1.5,n===void 0?[4,4]:[]),n!==void 0&&s.dot(c,"#78dcff",3),n!==void 0&&s.label(c,`${n.toFixed(2)} m`,"#bfeeff");return}let o=l=>e.kind==="fan"?[0,Math.sin(l),-Math.cos(l)]:[Math.cos(l),Math.sin(l),0],a=Array.from({length:33},(l,c)=>{let h=e.from+(e.to-e.from)*c/32;return Re(t,o(h).map(u=>u*e.reach))});s.line([de(t),...a,de(t)],i,1)}function rg(s,e,t,r){let i=["x","y","z"].map(h=>r.signal(`water/${e}/${h}`)??0),n=Math.hypot(...i);if(n<.005)return;let o=Me(de(t),[0,0,.55]),a=Me(o,i,(.5+2*n)/n),l=[-i[1]/n,i[0]/n,0],c=Me(a,i,-.15/n);s.line([o,a],"#5ee6d0",2.5),s.line([Me(c,l,.08),a,Me(c,l,-.08)],"#5ee6d0",2.5),s.label(a,`current ${n.toFixed(2)} m/s`,"#b9fff1")}function Mo(s,e,t,r,i,n){let o=t.fx/e.fx;for(let[a,l,c]of[["truth","#45f08b",[]],["estimate","#ff9f43",[6,4]]]){let h=n.points(`${a}/${e.name}`,["u","v"]);if(!(h.length<2)){s.strokeStyle=l,s.lineWidth=2,s.setLineDash([...c]),s.beginPath();for(let[u,m]of h)s.lineTo(r+t.cx+(u-e.cx)*o+.5,i+t.cy+(m-e.cy)*o+.5);s.closePath(),s.stroke(),s.setLineDash([])}}}function Rf(s,e,t,r){let[i,n]=[28,r+22],o=sg(130*t/e.fx),a=o*e.fx/t;s.save(),s.setLineDash([]),s.shadowColor="rgba(0, 12, 24, 0.9)",s.shadowBlur=3,s.fillStyle=s.strokeStyle="#ffffff",s.textAlign="center",s.font="600 13px system-ui, sans-serif",s.fillText("N",i,n),s.beginPath(),s.moveTo(i,n+6),s.lineTo(i+8,n+28),s.lineTo(i,n+23),s.lineTo(i-8,n+28),s.closePath(),s.fill();let[l,c]=[18,n+58];s.lineWidth=2,s.beginPath(),s.moveTo(l,c-6),s.lineTo(l,c),s.lineTo(l+a,c),s.lineTo(l+a,c-6),s.stroke(),s.fillText(o<1?`${Math.round(100*o)} cm`:`${o} m`,l+a/2,c-8),s.restore()}function sg(s){let e=10**Math.floor(Math.log10(s)),t=[5,2,1].find(r=>r*e<=s*(1+1e-9))??1;return Number((t*e).toPrecision(1))}var Ii=class{constructor(e){this.gl=e}gl;fence=null;beginTime=0;pauseEnd=0;responsiveEnd=0;begin(){this.fence&&this.gl.deleteSync(this.fence),this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.beginTime=performance.now()}skipPauses(){this.responsiveEnd=performance.now()+300}isReady(e){let{gl:t,fence:r}=this,i=t.isContextLost()||e-this.beginTime>2e3;return r&&(i||t.getSyncParameter(r,t.SYNC_STATUS)===t.SIGNALED)&&(t.deleteSync(r),this.fence=null,this.pauseEnd=Math.min(2*e-this.beginTime,e+100)),!this.fence&&(e>=this.pauseEnd||e<this.responsiveEnd)}};var ig=.3,To=.05,ng=Math.SQRT2,Po=Se([.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1]);function og(s){let e=[0,4,8,12].map(r=>[s[r],s[r+1],s[r+2],s[r+3]]);return[1,-1].flatMap(r=>[0,1,2].map(i=>e[3].map((n,o)=>n+r*e[i][o]))).map(r=>{let i=Math.hypot(r[0],r[1],r[2]);return r.map(n=>n/i)})}function ki(s,e){let t=og(e.clip),r=Ze(e.worldFromCamera),i=[];for(let n of s){let o=Re(r,n.centre);if(!t.every(l=>le(l,o)+l[3]+n.radius>0))continue;let a=n.corners.map(l=>Re(r,l));t.every(l=>a.some(c=>le(l,c)+l[3]>0))&&i.push([Math.hypot(...o)+n.radius,n])}return i.sort((n,o)=>n[0]-o[0]).map(([,n])=>n)}function Pf(s,e,t,r){let i=ag(t),n=de(r.worldFromCamera),o=[r.worldFromCamera[2],r.worldFromCamera[6],r.worldFromCamera[10]],a=lg(r),l=e.map(c=>{let h=c.corners.map(_=>le(Me(n,_,-1),o)),m=[Math.max(0,Math.min(...h)),Math.max(0,Math.max(...h))].flatMap(_=>a.map(w=>Me(n,w,_))),[p,y]=[Ro(c.corners,i),Ro(m,i)];return p.map(([_,w],E)=>[Math.max(_,y[E][0]),Math.min(w,y[E][1])])});return s.filter(c=>{let h=Ro(c.corners,i);return l.some(u=>[0,1].every(m=>h[m][0]<=u[m][1]+To&&h[m][1]>=u[m][0]-To)&&h[2][1]>=u[2][0]-To)})}function ag(s){return s[2]<ig?[...Lf(s),s]:[[1,0,-s[0]/s[2]],[0,1,-s[1]/s[2]],s]}function Ro(s,e){return e.map(t=>{let r=s.map(i=>le(t,i));return[Math.min(...r),Math.max(...r)]})}function lg({clip:s,worldFromCamera:e}){return[[-1,-1],[-1,1],[1,-1],[1,1]].map(([r,i])=>{let n=(i+s[6])/s[5],o=(r+s[2]-s[1]*n)/s[0];return[e[0]*o+e[1]*n-e[2],e[4]*o+e[5]*n-e[6],e[8]*o+e[9]*n-e[10]]})}function Lf(s){let e=[-s[0],-s[1],-s[2]],t=wt(it(e,Math.abs(s[2])<.9?[0,0,1]:[1,0,0]));return[t,it(t,e)]}function If(s,e){let t=[...Lf(e),[-e[0],-e[1],-e[2]]],r=[1/0,1/0,1/0],i=[-1/0,-1/0,-1/0];for(let{centre:h,radius:u}of s)t.forEach((m,p)=>{r[p]=Math.min(r[p],le(m,h)-u),i[p]=Math.max(i[p],le(m,h)+u)});let n=Math.max(i[0]-r[0],i[1]-r[1])/2,o=20,a=[1/n,1/n,2/(i[2]+o-r[2])],l=[(r[0]+i[0])/2,(r[1]+i[1])/2,(i[2]+o+r[2])/2],c=t.flatMap((h,u)=>[h[0]*a[u],h[1]*a[u],h[2]*a[u],-a[u]*l[u]]);return[Se([...c,0,0,0,1]),2*n]}function kf(s,e){if(!(s.density>0)||le(s.normal,s.normal)===0)return!1;let t=Ze(e.worldFromCamera),r=s.corners.map(u=>Re(t,u)),i=Xs(e.worldFromCamera,s.normal),n=r.map(u=>-u[2]);if(Math.min(...n)<=0)return!1;let o=Math.min(...r.map(u=>Math.abs(le(i,u)))),a=Math.max(...r.map(u=>Math.hypot(...u))),l=Math.hypot(i[0],i[1]),c=Math.min(e.intrinsics.fx,e.intrinsics.fy),h=Math.max(...n)/c*(1+l*a/o);return s.density*h<=ng}function Ff(s,e){let r=s.instances.filter(i=>s.radius(i)>e).flatMap(({pieces:i})=>i.flatMap(({corners:n})=>n.map(o=>o[2])));return r.length?r.reduce((i,n)=>Math.min(i,n)):-1/0}var Fi=512,Cf=1024,cg=.008,Ct=512,fg=80*Math.PI/180,Nf=1.02,ug=1024,Is=class{constructor(e,t,r){this.gl=e;this.width=t;this.height=r;this.texture=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.texture),e.texStorage2D(e.TEXTURE_2D,1,e.DEPTH_COMPONENT24,t,r);for(let[i,n]of[[e.TEXTURE_COMPARE_MODE,e.COMPARE_REF_TO_TEXTURE],[e.TEXTURE_COMPARE_FUNC,e.LEQUAL],[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D,i,n);this.buffer=e.createFramebuffer(),e.bindFramebuffer(e.FRAMEBUFFER,this.buffer),e.framebufferTexture2D(e.FRAMEBUFFER,e.DEPTH_ATTACHMENT,e.TEXTURE_2D,this.texture,0),e.drawBuffers([e.NONE]),this.begin(0,0,t,r)}gl;width;height;texture;buffer;begin(e,t,r,i){let n=this.gl;n.bindFramebuffer(n.FRAMEBUFFER,this.buffer),n.viewport(e,t,r,i),n.enable(n.SCISSOR_TEST),n.scissor(e,t,r,i),n.depthMask(!0),n.clearDepth(1),n.clear(n.DEPTH_BUFFER_BIT),n.disable(n.SCISSOR_TEST)}},Ci=class{constructor(e,t,r){this.gl=e;this.programs=t;this.instanceBlocks=r;let i=[Fi,Cf].map(n=>[n,new Is(e,n,n)]);this.suns=Object.fromEntries(i),this.sunMap=this.suns[Fi]}gl;programs;instanceBlocks;suns;sunMap;textureFromWorld=Se([1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]);lift=0;lampMaps=null;projectorMap=null;sunKey="";lampKeys=[];updateSunShadows(e,t,r){let i=`${r} ${t} ${e.map(l=>`${l.instance.index}.${l.firstIndex}`)}`;if(i===this.sunKey)return;this.sunKey=i;let[n,o]=If(e,t),a=o/Fi<=cg?Fi:Cf;this.sunMap=this.suns[a],this.textureFromWorld=Ie(Po,n),this.lift=1.5*o/a,this.sunMap.begin(0,0,a,a),this.draw(e,n)}updateLampShadows(e,t,r){this.lampMaps??=new Is(this.gl,2*Ct,2*Ct),e.forEach(({lamp:i,worldFromLamp:n},o)=>{let a=i.shadow?`${r} ${i.half_angle} ${n}`:"none";if(a===this.lampKeys[o])return;this.lampKeys[o]=a;let[l,c]=[o%2,o>>1];this.lampMaps.begin(Ct*l,Ct*c,Ct,Ct),i.shadow&&this.drawShadowMap(n,Of(i),t)})}updateProjectorShadows(e,t,r){this.projectorMap??=new Is(this.gl,t.width,t.height),this.projectorMap.begin(0,0,t.width,t.height),this.drawShadowMap(e,t,r)}drawShadowMap(e,t,r){let i=rr(t,!0),n=ki(r,{worldFromCamera:e,clip:i,intrinsics:t});this.draw(n.filter(ks),Ie(i,Ze(e)),!0)}draw(e,t,r=!1){let i=this.gl;i.enable(i.DEPTH_TEST),i.depthFunc(i.LEQUAL),i.enable(i.POLYGON_OFFSET_FILL),i.polygonOffset(1.5,2),i.useProgram(this.programs.get("shadow",{})),this.instanceBlocks.fill(t);for(let n of e)this.instanceBlocks.drawPiece(n,r);i.disable(i.POLYGON_OFFSET_FILL)}};function ks(s){return s.instance.visual.opacity>=1}function Of(s){let e=Ct/2/(Nf*Math.tan(Math.min(s.half_angle,fg))),t=(Ct-1)/2,[r,i]=[Ct,Ct];return{width:r,height:i,fx:e,fy:e,cx:t,cy:t,skew:0,near:.1,far:20}}function Df(s,e,t){let r=ug/Math.max(t,e),i=Math.max(1,Math.round(r*e)),n=Math.max(1,Math.round(r*t)),o=Math.tan(s.fovy/2);return{width:i,height:n,fx:i/2/(o*e/t),fy:n/2/o,cx:(i-1)/2,cy:(n-1)/2,skew:0,near:.1,far:20}}function Uf(s,e){let t=new Float32Array(112),r=Ze(e);return s.forEach(({lamp:i,worldFromLamp:n},o)=>{let[a,l]=[.25+.5*(o%2),.25+.5*(o>>1)],c=Se([.25,0,0,a,0,.25,0,l,0,0,.5,.5,0,0,0,1]),h=Ie(c,rr(Of(i),!0));t.set(xt(Ie(Ie(h,Ze(n)),e)),16*o);let u=Ie(r,n),m=Math.cos(i.half_angle),p=Math.cos((1-i.softness)*i.half_angle),y=2*Nf*Math.tan(i.half_angle)/Ct,_=u;t.set([...de(_),m],64+4*o),t.set([_[2],_[6],_[10],1/Math.max(p-m,1e-5)],80+4*o),t.set([...i.colour.map(w=>w*i.intensity),1.5*y],96+4*o)}),t}function Vf(s,e,t,r){let i=Ie(Ze(e),r),n=Ie(Po,rr(t,!0)),o=Ze(i);return Float32Array.from([...xt(Ie(n,i)),...de(o),s.laser?1:0,o[2],o[6],o[10],1.5/Math.min(t.fx,t.fy)])}function Bf(s,e,t,r,i){let{fx:n,fy:o,cx:a,cy:l,skew:c}=e,[h,u]=[1/n,-1/o],m=c*u/n,p=u*(-.5-l),y=h*(-.5-a)-c*p/n,_=E=>E.map(x=>r*x),w=new Float32Array(76);return w.set([...s.absorption,s.field[0],...s.scattering,s.field[1],...Array.from({length:8},(E,x)=>i[x]??0),0,s.exposure,s.scale,0,..._(s.beam),0,...s.beam_loss,0,..._(s.total),0,...s.loss,0,...s.reflectance,s.sun[2],...s.phase,y,p,-1,0,h,0,0,0,-m,u,0,0]),t.forEach(({lamp:E,index:x},M)=>{let S=Math.cos(E.half_angle);w.set([...s.lamps[x],S*S,+(E.half_angle<Math.PI/2)],4*(15+M))}),w}var[hg,mg]=[.0625,.1875],dg=.1875,pg=24;function zf(s,e,t){let r=Math.sqrt(s.fx*s.fy),i=Math.min(Math.round(Math.log(Math.max(.41*r,1))/Math.log(2.6)),7);if(!t||i<1)return{deviations:[],spreads:[],reach:[],highestFrequency:120};let n=(.41*r)**(1/i),o=Array.from({length:i+1},(l,c)=>n**c),a=o.map(l=>l/r);return{deviations:a,spreads:o.map(vg),reach:a.map(l=>gg(l,e,s)),highestFrequency:Math.min(120,.3*r)}}function Gf(s){return{RADIUS:Wf(s),SPREAD:Math.round(1e3*s)}}function Wf(s){return s>0?Math.min(Math.ceil(3*s),pg):0}function gg(s,e,t){let[r,i]=[t.width/t.fx/2,t.height/t.fy/2],n=[r,i].map(a=>e.map(l=>Math.min(s*l,a)**2)),o=0;for(let a of n[0])for(let l of n[1])o+=Math.sqrt(1+a+l);return e.length**2/o}function vg(s,e){let[t,r]=[0,0];for(let n=0;n<=e;++n)t=t/4+(n<2?hg:mg),r=r/4+dg;let i=(s/2**(e+1))**2-t-r;return i>.01?yg(i):0}function yg(s){let[e,t]=[.1,2*Math.sqrt(s)+1];for(;t-e>5e-4;){let r=(e+t)/2,[i,n]=[1,0];for(let o=1;o<=Wf(r);++o){let a=2*Math.exp(-o*o/(2*r*r));i+=a,n+=a*o*o}n<s*i?e=r:t=r}return Math.round(500*(e+t))/1e3}function Hf(s,e,t){let r=new Float32Array(4*t*128),i=Math.log(e.highestFrequency/.5)/35,n=Array.from({length:36},(l,c)=>.5*Math.exp(c*i)),o=n.map(l=>_g(s,l)),a=[0,...e.deviations].map(l=>n.map(c=>Math.exp(-2*(Math.PI*c*l)**2)));for(let l=0;l<128;++l){let c=l/127,h=s.scale*c/Math.max(1-c,1e-6);for(let u=0;u<3;++u){let[m,p]=[s.absorption[u],s.scattering[u]],y=s.field[0]+s.field[1]*Math.sqrt(m*h),[_,w]=[Math.exp(-(m+p)*h),Math.exp(-h*m-y*p*h)];if(!(w-_>1e-9))continue;let E=o.map(M=>{let S=(M/s.forward)**12;return Math.exp(h*(p*(M-(y-(1-s.forward))*S)-(m+p)))});bg(a,E,_,w).forEach((M,S)=>r[4*(128*S+l)+u]=M)}}return r}function _g({transform:s},e){let{values:t,min_frequency:r,max_frequency:i}=s,n=Math.log(e/r)/Math.log(i/r)*(t.length-1),o=Math.min(Math.max(Math.floor(n),0),t.length-2);return t[o]+(n-o)*(t[o+1]-t[o])}function bg(s,e,t,r){let i=s.map(m=>[...m.map((p,y)=>p/e[y]),1e3/r]),n=[...e.map(m=>(m-t)/m),1e3*(r-t)/r],o=(m,p)=>m.reduce((y,_,w)=>y+_*p[w],0),a=i.map(m=>o(m,n)),l=i.map((m,p)=>i.map((y,_)=>o(m,y)*(p===_?1+1e-9:1))),c=s.map(()=>0),h=s.map((m,p)=>p);for(;h.length;){let m=wg(h.map(y=>[...h.map(_=>l[y][_]),a[y]])),p=Math.min(...m);if(p>=0){h.forEach((y,_)=>c[y]=m[_]);break}h=h.filter((y,_)=>_!==m.indexOf(p))}let u=c.reduce((m,p)=>m+p,0);return u>0?c.map(m=>m*(r-t)/u):c}function wg(s){let e=s.length;for(let r=0;r<e;++r){let i=r;for(let n=r+1;n<e;++n)Math.abs(s[n][r])>Math.abs(s[i][r])&&(i=n);[s[r],s[i]]=[s[i],s[r]];for(let n=r+1;n<e;++n){let o=s[n][r]/s[r][r];for(let a=r;a<=e;++a)s[n][a]-=o*s[r][a]}}let t=new Array(e).fill(0);for(let r=e-1;r>=0;--r){let i=s[r][e];for(let n=r+1;n<e;++n)i-=s[r][n]*t[n];t[r]=i/s[r][r]}return t}var ls=[41,31],xg=Math.sqrt(1-1/1.34**2),Eg=.05,Ag=.1,Yf=.84,qf=60,Xf=1e9;function Kf(s,e,t,r,i,n){let[o,a]=ls,l=new Float32Array(4*o*a),{fx:c,fy:h,cx:u,cy:m,skew:p,width:y,height:_}=t,w=Lo(s,Math.max(r,0),i,n);for(let E=0;E<a;++E)for(let x=0;x<o;++x){let M=-(_*E/(a-1)-.5-m)/h,S=(y*x/(o-1)-.5-u-p*M)/c;l.set(w(Xr(e,wt([S,M,-1]))),4*(o*E+x))}return l}function Lo(s,e,t,r){let{sun:i,open_water:n}=s,o=s.total.map((l,c)=>l*Math.exp(-s.loss[c]*e)),a=s.beam.map((l,c)=>Math.min(l*Math.exp(-s.beam_loss[c]*e),o[c]));return l=>{let c=l[2],h=c>0?Math.min(e/Math.max(c,1e-6),Xf):Xf,u=le(l,i),m=Mg(n.asymmetry,u),p=3*(1+Yf*u*u)/(4*Math.PI*(3+Yf)),y=.5+(.5-n.backscatter)*c/Math.sqrt(c*c+Ag);return[0,1,2].map(_=>{let w=n.attenuation[_],E=n.scattering[_],x=n.molecules[_],M=a[_]*(Math.PI/i[2])*(E*m+x*p)*jf(w*(1-c/i[2]),h),S=s.reflectance[_]*o[_],F=o[_]-a[_],L=(E*(y*F+(1-y)*S)+.5*x*(F+S))*jf(w-s.loss[_]*c,h),C=c>0&&!r?Sg(s,_,c)*Math.exp(-Math.min(w*h,700)):0;return t*(M+L+C)})}}function Sg(s,e,t){let r=Math.min(Math.max((t-xg)/(2*Eg)+.5,0),1),i=r*r*(3-2*r);return i*s.open_water.window+(1-i)*s.reflectance[e]*s.total[e]}function Mg(s,e){let t=s,r=Math.sqrt(1+t*t-2*t*Math.min(Math.max(e,-1),1));return(1-t*t)/(4*Math.PI*r**3)}function jf(s,e){let t=Math.min(Math.max(s*e,-qf),qf);return Math.abs(t)<1e-4?e*(1-t/2):(1-Math.exp(-t))/s}var Tg=[2654435769,2135587861],[Rg,Pg]=[[3210233709,484763065],[2496678331,321982955]],Lg=[[3605593784,1717173651],[2692095332,2025677871],[3875765969,2696161499]];function Oi(s){return[parseInt(s.slice(2,10),16),parseInt(s.slice(10),16)]}function $f(s){let e=Ni([s[0]^s[0]>>>30,s[1]^(s[1]>>>30|s[0]<<2)],Rg),t=Ni([e[0]^e[0]>>>27,e[1]^(e[1]>>>27|e[0]<<5)],Pg);return[(t[0]^t[0]>>>31)>>>0,(t[1]^(t[1]>>>31|t[0]<<1))>>>0]}function cs(s,...e){return e.reduce((t,r,i)=>$f(Qf(t,Ni(Ig(r),Lg[i]))),s)}function ot(s,e){let[t,r]=$f(Qf(s,Ni([0,e+1],Tg)));return(t*2**21+(r>>>11))*2**-53}function Ig(s){return[Math.floor(s/2**32)>>>0,s>>>0]}function Qf(s,e){let t=(s[1]>>>0)+(e[1]>>>0);return[s[0]+e[0]+ +(t>=2**32)>>>0,t>>>0]}function Ni(s,e){let[t,r,i,n]=[s[1]&65535,s[1]>>>16,e[1]&65535,e[1]>>>16],o=r*i+(t*i>>>16),a=t*n+(o&65535);return[r*n+Math.floor(o/65536)+Math.floor(a/65536)+Math.imul(s[0],e[1])+Math.imul(s[1],e[0])>>>0,Math.imul(s[1],e[1])>>>0]}var Kt=10,Io=2e4,kg=4e6,[Fg,Cg,Ng]=[.02,4,3],[tu,Og,Dg,Ug,Vg]=[64,.25,2,.02,.08],Jf=.5,Bg=0,[zg,Gg,Wg,Hg]=[.02,9,.1,4];function Di(s,e,t,r,i){let n=s.classes.map(o=>{let a=new ko(o,s,e,t,r);if(o.concentration>0)if(o.is_plume)qg(a,s.source,i);else for(Zf(a,i);a.isFull;)a.shorten(),Zf(a,i);return a.records});return Float32Array.from(n.flat())}var ko=class{constructor(e,t,r,i,n){this.sizeClass=e;this.drift=r;this.m=i;this.key=Oi(e.key),this.focal=Math.sqrt(n.fx*n.fy);let o=e.is_plume?t.range*Hg:t.range;this.reach=Math.min(o,e.max_diameter*this.focal/Jf,n.far);let[a,l]=[(n.cy+.5)/n.fy,(n.cy+.5-n.height)/n.fy],c=Math.abs(n.skew)/n.fx*Math.max(Math.abs(a),Math.abs(l)),[h,u]=[-(n.cx+.5)/n.fx-c,(n.width-.5-n.cx)/n.fx+c];this.slopes=[h,u,l,a];let{velocity:m}=r;this.motion=this.toCamera(m[0],m[1],m[2]+e.rise_speed).map(p=>p*t.exposure_time)}sizeClass;drift;m;records=[];key;slopes;focal;reach;motion;get isFull(){return this.records.length>=Kt*Io}shorten(){let[e,t,r,i]=this.slopes,n=.9*Io/this.sizeClass.concentration;this.reach=Math.min(Math.cbrt(3*n/((t-e+.05)*(i-r+.05))),.7*this.reach),this.records.length=0}toCamera(e,t,r){let{m:i}=this;return[i[0]*e+i[4]*t+i[8]*r,i[1]*e+i[5]*t+i[9]*r,i[2]*e+i[6]*t+i[10]*r]}mayContain([e,t,r],i){let{slopes:n}=this;if(r>i||e*e+t*t+r*r>(this.reach+i)**2)return!1;let o=n.map(a=>i*Math.hypot(1,a));return n[0]*-r-e<=o[0]&&e-n[1]*-r<=o[1]&&n[2]*-r-t<=o[2]&&t-n[3]*-r<=o[3]}diameterOf(e){let{min_diameter:t,max_diameter:r,slope:i}=this.sizeClass,n=(r/t)**(1-i);return t*(1+e*(n-1))**(1/(1-i))}add([e,t,r],i,n,o){let{slopes:a,sizeClass:l,motion:c}=this;if(-r<Vg)return;let h=i-.02*r+.5*(Math.abs(c[0])+Math.abs(c[1])+Math.abs(c[2]));if(e<a[0]*-r-h||e>a[1]*-r+h||t<a[2]*-r-h||t>a[3]*-r+h)return;let u=Math.hypot(e,t,r)/Math.min(this.reach,i*this.focal/Jf);if(u>=1||this.isFull)return;let m=Math.min((1-u)/Og,1),[p,y]=[c,1];if(l.kind===Bg){y=-Math.log(Math.max(ot(o,0),Ug));let _=i*Dg*ot(o,1);p=c.map((w,E)=>w+_*(2*ot(o,E+2)-1))}this.records.push(e,t,r,i/2,...p,n*m,l.reflectance*y,l.kind)}};function Zf(s,e){let{m:t,sizeClass:r,drift:i,key:n}=s,{concentration:o,depth_scale:a}=r,l=Math.min(Math.max(Math.cbrt(Ng/o),Fg),Cg),c=Math.min(o*l**3,tu/2),h=[0,0,r.rise_speed*i.time],u=[t[3],t[7],t[11]].map((w,E)=>w-(i.displacement[E]+h[E])),[m,p]=eu(s,u,l);for(;m.reduce((w,E,x)=>w*(p[x]-E+1),1)>kg;)s.reach*=.7,[m,p]=eu(s,u,l);let y=.8660254037844387*l+r.max_diameter,_=e-t[11];for(let w=m[0];w<=p[0]&&!s.isFull;++w)for(let E=m[1];E<=p[1];++E)for(let x=m[2];x<=p[2];++x){let M=s.toCamera((w+.5)*l-u[0],(E+.5)*l-u[1],(x+.5)*l-u[2]);if(!s.mayContain(M,y))continue;let S=cs(n,w,E,x),F=Yg(ot(S,0),c);for(let L=0;L<F;++L){let C=1+5*L,[U,V,N]=[w,E,x].map((W,Z)=>(W+ot(S,C+Z))*l-u[Z]),R=_-N;if(R<0)continue;let H=a===null?1:Math.exp(-R/a)-ot(S,C+4);if(H<=0)continue;let z=a===null?1:Math.min(H/.05,1),j=s.diameterOf(ot(S,C+3));s.add(s.toCamera(U,V,N),j,z,cs(S,L,0,0))}}}function eu({slopes:s,reach:e,m:t},r,i){let n=Math.hypot(Math.max(...s.slice(0,2).map(Math.abs)),Math.max(...s.slice(2).map(Math.abs))),o=Math.atan(n),a=[0,1,2].map(l=>{let c=Math.acos(Math.min(Math.max(-t[4*l+2],-1),1)),h=c<=o?1:Math.cos(c-o),u=Math.PI-c<=o?-1:Math.cos(Math.min(c+o,Math.PI));return[e*Math.min(u,0),e*Math.max(h,0)]});return[0,1].map(l=>a.map((c,h)=>Math.floor((r[h]+c[l])/i)))}function Yg(s,e){let[t,r]=[0,Math.exp(-e)],i=r;for(;s>i&&t<tu;)t+=1,r*=e/t,i+=r;return t}function qg(s,e,t){let{m:r,sizeClass:i,drift:n,key:o}=s,[a,l,c]=[i.concentration,i.rise_speed,t-e[2]];if(c<=0)return;let h=Math.floor(a*n.time),u=Math.max(Math.ceil(a*(n.time-c/l)),0,h-Io+1);for(let m=u;m<=h;++m){let p=cs(o,m),y=n.time-m/a,_=l*y,w=2*Math.PI*ot(p,0),E=Wg*_*Math.sqrt(ot(p,1)),x=2*Math.PI*ot(p,2)+Gg*y,M=zg*Math.min(10*_,1),S=[E*Math.cos(w)+M*Math.cos(x),E*Math.sin(w)+M*Math.sin(x),_],[F,L,C]=S.map((U,V)=>e[V]+n.velocity[V]*y+U-r[4*V+3]);s.add(s.toCamera(F,L,C),s.diameterOf(ot(p,3)),1,p)}}var Xg=1.5,Fo=8,jg=[4,4,2],Ui=class{constructor(e,t){this.gl=e;this.programs=t;this.records=e.createBuffer(),this.lens=e.createBuffer(),this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,this.records);let r=0;jg.forEach((i,n)=>{e.enableVertexAttribArray(Fo+n),e.vertexAttribPointer(Fo+n,i,e.FLOAT,!1,4*Kt,r),e.vertexAttribDivisor(Fo+n,1),r+=4*i}),e.bindVertexArray(null)}gl;programs;records;lens;vertexArray;draw({spec:e,records:t},r,i){let{gl:n}=this;if(n.clearColor(0,0,0,0),n.clear(n.COLOR_BUFFER_BIT),!t.length)return;n.bindBuffer(n.UNIFORM_BUFFER,this.lens);let o=Float32Array.of(e.aperture/2,1/e.focus_distance,Xg,0);n.bufferData(n.UNIFORM_BUFFER,o,n.STREAM_DRAW),n.bindBufferBase(n.UNIFORM_BUFFER,jt.ParticleLens,this.lens),n.useProgram(this.programs.get("particle",r?{LAMPS:r,...i}:i)),n.enable(n.BLEND),n.blendFunc(n.ONE,n.ONE_MINUS_SRC_ALPHA),n.bindVertexArray(this.vertexArray),n.bindBuffer(n.ARRAY_BUFFER,this.records),n.bufferData(n.ARRAY_BUFFER,Kg(t),n.STREAM_DRAW),n.drawArraysInstanced(n.TRIANGLE_STRIP,0,4,t.length/Kt),n.bindVertexArray(null),n.disable(n.BLEND)}};function Kg(s){let e=new Float64Array(s.length/Kt);for(let i=0,n=0;i<e.length;++i,n+=Kt)e[i]=s[n]**2+s[n+1]**2+s[n+2]**2;let t=Array.from(e.keys()).sort((i,n)=>e[n]-e[i]),r=new Float32Array(s.length);return t.forEach((i,n)=>r.set(s.subarray(Kt*i,Kt*(i+1)),Kt*n)),r}var Fs=6,ru=.42,$g=.5,Qg=40,Jg=5,Vi=5;function su(s,e,t,r,i){let n=Ze(i),o=Oi(s.key),a=[];for(let l of In(s,e,t,r)){let c=Math.sqrt(l[jr]),h=ru*c,u=Math.min(Math.max(t-l[Kr],0)/$g,1)/Fs,m=s.scattering*l[sr]*u/(2*Math.PI*h*h);if(!(m<=1e-4))for(let p of Zg(cs(o,l[$r]))){let y=Re(n,p.map((_,w)=>l[w]+c*_));y[2]<3*h&&Math.hypot(...y)<Qg&&a.push(...y,h,m)}}return a.length?{lumps:Float32Array.from(a),colour:s.colour}:null}function Zg(s){let e=Array.from({length:Fs},(i,n)=>[0,1,2].map(o=>ot(s,Jg+3*n+o))),t=[0,1,2].map(i=>e.reduce((n,o)=>n+o[i],0)/Fs),r=Math.sqrt(12*(1-ru**2)*Fs/(Fs-1));return e.map(i=>i.map((n,o)=>r*(n-t[o])))}var nu=8,e0=4,iu=2.5,Bi=class{constructor(e,t){this.gl=e;this.programs=t;this.lumps=e.createBuffer(),this.block=e.createBuffer(),this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,this.lumps);for(let[r,i,n]of[["place",4,0],["depth",1,16]])e.enableVertexAttribArray(Ft[r]),e.vertexAttribPointer(Ft[r],i,e.FLOAT,!1,4*Vi,n),e.vertexAttribDivisor(Ft[r],1);e.bindVertexArray(null)}gl;programs;lumps;block;vertexArray;draw({lumps:e,colour:t},r,i){let{gl:n}=this,[o,a]=[1/0,0];for(let c=0;c<e.length;c+=Vi){let h=Math.hypot(e[c],e[c+1],e[c+2]);o=Math.min(o,h-iu*e[c+3]),a=Math.max(a,h+iu*e[c+3])}o=Math.max(o,0),n.bindBuffer(n.UNIFORM_BUFFER,this.block);let l=Float32Array.of(o,(a-o)/(e0-1),0,0,...t,0);n.bufferData(n.UNIFORM_BUFFER,l,n.STREAM_DRAW),n.bindBufferBase(n.UNIFORM_BUFFER,jt.Clouds,this.block),n.clearColor(0,0,0,0),n.clear(n.COLOR_BUFFER_BIT),n.useProgram(this.programs.get("cloud",r?{LAMPS:r,...i}:i)),n.enable(n.BLEND),n.blendFunc(n.ONE,n.ONE),n.bindVertexArray(this.vertexArray),n.bindBuffer(n.ARRAY_BUFFER,this.lumps),n.bufferData(n.ARRAY_BUFFER,e,n.STREAM_DRAW),n.drawArraysInstanced(n.TRIANGLE_STRIP,0,4,e.length/Vi),n.bindVertexArray(null),n.disable(n.BLEND)}};var zi=class{constructor(e,t){this.gl=e;this.format=t}gl;format;entries=new Map;find({width:e,height:t},r){let{gl:i,format:n}=this,o=`${e} ${t} ${r}`,a=this.entries.get(o);if(a)return a;this.entries.size>7&&this.deleteAll(),a={surfaces:this.depthTarget(e,t),wateredSurfaces:null,colours:this.target(e,t,1,i.RGBA8),particles:null,clouds:null,shafts:null,sources:[],levels:[]};let[l,c]=[e,t];for(let h=0;h<Math.max(r,1);++h){[l,c]=[Math.ceil(l/2),Math.ceil(c/2)];let u=h===0?Math.min(r,1)+1:r-h;a.sources.push(this.target(l,c,u,n)),a.levels.push({rows:this.target(l,c,1,n),total:this.target(l,c,1,n)})}return this.entries.set(o,a),a}depthTarget(e,t){let{gl:r}=this,i=r.createRenderbuffer();r.bindRenderbuffer(r.RENDERBUFFER,i),r.renderbufferStorage(r.RENDERBUFFER,r.DEPTH_COMPONENT24,e,t);let n=this.target(e,t,1,this.format);return r.framebufferRenderbuffer(r.FRAMEBUFFER,r.DEPTH_ATTACHMENT,r.RENDERBUFFER,i),{...n,depth:i}}target(e,t,r,i){let{gl:n}=this,o=Array.from({length:r},()=>this.texture(e,t,i)),a=n.createFramebuffer();return n.bindFramebuffer(n.FRAMEBUFFER,a),o.forEach((l,c)=>n.framebufferTexture2D(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+c,n.TEXTURE_2D,l,0)),n.drawBuffers(o.map((l,c)=>n.COLOR_ATTACHMENT0+c)),{buffer:a,textures:o,width:e,height:t}}texture(e,t,r){let{gl:i}=this,n=i.createTexture();i.bindTexture(i.TEXTURE_2D,n),i.texStorage2D(i.TEXTURE_2D,1,r,e,t);for(let o of[i.TEXTURE_MIN_FILTER,i.TEXTURE_MAG_FILTER])i.texParameteri(i.TEXTURE_2D,o,i.LINEAR);for(let o of[i.TEXTURE_WRAP_S,i.TEXTURE_WRAP_T])i.texParameteri(i.TEXTURE_2D,o,i.CLAMP_TO_EDGE);return n}upload(e,t,r,i){let{gl:n}=this;n.bindTexture(n.TEXTURE_2D,e),n.texSubImage2D(n.TEXTURE_2D,0,0,0,t,r,n.RGBA,n.FLOAT,i)}deleteAll(){let{gl:e}=this;for(let{surfaces:t,wateredSurfaces:r,colours:i,particles:n,clouds:o,shafts:a,sources:l,levels:c}of this.entries.values())for(let h of[t,i,...[r,n,o,a].filter(u=>u!==null),...l,...c.flatMap(({rows:u,total:m})=>[u,m])]){for(let u of h.textures)e.deleteTexture(u);e.deleteFramebuffer(h.buffer),h.depth&&e.deleteRenderbuffer(h.depth)}this.entries.clear()}};var t0=16,r0="6e4",Gi=class s{constructor(e,t,r,i){this.gl=e;this.programs=t;this.nodes=r;this.format=i?e.RGBA16F:e.RGBA32F,this.switches=i?{FAR:r0}:{},this.particlePass=new Ui(e,t),this.cloudPass=new Bi(e,t),this.pool=new zi(e,this.format),this.map=this.pool.texture(ls[0],ls[1],this.format)}gl;programs;nodes;switches;format;pool;particlePass;cloudPass;map;tables=[];table=null;currentTargets=null;radiance=null;static make(e,t,r){return["EXT_color_buffer_float","OES_texture_float_linear","EXT_float_blend"].every(n=>e.getExtension(n))?new s(e,t,r,!1):!e.getExtension("EXT_color_buffer_float")&&!e.getExtension("EXT_color_buffer_half_float")?null:new s(e,t,r,!0)}plan(e,t){return zf(e,this.nodes,t)}prepare(e,t,r,i,n,o,a){return this.table=i.deviations.length?this.tableOf(e,i):null,this.pool.upload(this.map,ls[0],ls[1],Kf(e,t,r,n,o,a)),this.bind(J.open_water_map,this.map),this.table&&this.bind(J.weight_table,this.table),this.currentTargets=this.pool.find(r,i.deviations.length),this.radiance=this.currentTargets.surfaces.textures[0],this.currentTargets.surfaces.buffer}drawOver(e){let{gl:t}=this,r=this.currentTargets,{width:i,height:n}=r.surfaces,o=r.wateredSurfaces??=this.pool.depthTarget(i,n);this.bind(J.surface_image,r.surfaces.textures[0]),this.begin(o),t.depthMask(!0),t.clear(t.DEPTH_BUFFER_BIT),e(),this.radiance=o.textures[0]}develop(e,t,r,i,n,o,a,l){let c=this.pool.find(t,r.deviations.length),h=e.lamp_veil?i:0,u=this.table?{BLUR:1}:{};if((r.spreads.length||h)&&(this.drawScattered(c,r,h),this.bind(J.level_0,c.levels[0].total.textures[0]),u.SCATTERED=1),this.bind(J.surface_image,this.radiance),o){let m=c.particles??=this.pool.target(t.width,t.height,1,this.format);this.begin(m),this.particlePass.draw(o,i,this.switches),this.bind(J.particle_image,m.textures[0]),u.PARTICLES=1}if(a){let m=[t.width,t.height].map(y=>Math.ceil(y/nu)),p=c.clouds??=this.pool.target(m[0],m[1],3,this.format);this.begin(p),this.cloudPass.draw(a,i,this.switches),p.textures.forEach((y,_)=>this.bind(J.cloud_layers_map+_,y)),u.CLOUDS=1}if(l){let m=[t.width,t.height].map(y=>Math.ceil(y/Number(l.RATIO))),p=c.shafts??=this.pool.target(m[0],m[1],1,this.format);this.draw("light_shafts",l,p),this.bind(J.shaft_image,p.textures[0]),u.SHAFTS=l.RATIO}return e.linear&&(u.LINEAR=1),n&&(u.GREY=1),this.draw("developed",u,c.colours),c.colours.textures[0]}present(e,t,r,{width:i,height:n},o){let{gl:a}=this;this.bind(J.level_0,e),a.bindFramebuffer(a.FRAMEBUFFER,t),a.viewport(r[0],r[1],i,n),a.useProgram(this.programs.get("presented",o?{}:{FLIPPED:1},"presented")),a.drawArrays(a.TRIANGLES,0,3)}drawScattered({sources:e,levels:t},r,i){let n=r.spreads.length;this.bind(J.surface_image,this.radiance),this.draw("scattered",{N_LEVELS:Math.min(n,1)},e[0]),n>1&&(this.bind(J.surface_image,e[0].textures[1]),this.draw("scattered",{WIDE:1,N_LEVELS:n-1},e[1]));for(let o=2;o<e.length;++o)e[o-1].textures.slice(1).forEach((a,l)=>this.bind(J.level_0+l,a)),this.draw("reduced",{N_LEVELS:e[o].textures.length},e[o]);for(let o=t.length-1;o>=0;--o){let a=r.spreads[o]??0,l=Gf(a);this.bind(J.level_0,e[o].textures[0]),a>0&&(this.draw("blurred_rows",{...l},t[o].rows),this.bind(J.level_0,t[o].rows.textures[0])),o+1<t.length&&(this.bind(J.level_1,t[o+1].total.textures[0]),l.WIDER=1),o===0&&i&&(this.bind(J.level_2,e[0].textures.at(-1)),l.LAMPS=i),n||(l.VEIL_ONLY=1),this.draw("blurred",l,t[o].total)}}begin(e){this.gl.bindFramebuffer(this.gl.FRAMEBUFFER,e.buffer),this.gl.viewport(0,0,e.width,e.height)}draw(e,t,r){let{gl:i}=this;this.begin(r),i.useProgram(this.programs.get(e,{...this.switches,...t},"screen")),i.drawArrays(i.TRIANGLES,0,3)}bind(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}tableOf(e,t){let r=t.deviations.join(),i=this.tables.find(o=>o.key===r&&o.optics===e.transform);if(i)return i.texture;this.tables.length>=t0&&this.gl.deleteTexture(this.tables.shift().texture);let n=this.pool.texture(128,9,this.format);return this.pool.upload(n,128,9,Hf(e,t,9)),this.tables.push({optics:e.transform,key:r,texture:n}),n}};function au(s,{drift:e,worldFromCamera:t,water:r},i){return!s?.classes.length||!e?null:{spec:s,records:Di(s,e,t,i,r.surface_height)}}function lu(s,{drift:e,puffs:t,worldFromCamera:r}){return!s?.sediment||!t||!e?null:su(s.sediment,t,e.time,e.velocity,r)}function No(s){return{reals:new Float64Array(s*s),imaginaries:new Float64Array(s*s)}}var Wi=class{constructor(e){this.n=e;this.cosines=Float64Array.from({length:e/2},(r,i)=>Math.cos(2*Math.PI*i/e)),this.sines=Float64Array.from({length:e/2},(r,i)=>Math.sin(2*Math.PI*i/e));let t=Math.round(Math.log2(e));this.reversedIndices=Array.from({length:e},(r,i)=>{let n=0;for(let o=0;o<t;++o)i&1<<o&&(n|=1<<t-1-o);return n})}n;cosines;sines;reversedIndices;transform({reals:e,imaginaries:t},r){let{n:i}=this;for(let n=0;n<i;++n)this.pass(e,t,i*n,1,1,r);this.pass(e,t,0,i,i,r)}pass(e,t,r,i,n,o){let{n:a,reversedIndices:l,cosines:c,sines:h}=this;for(let u=0;u<a;++u){if(l[u]<=u)continue;let[m,p]=[r+i*u,r+i*l[u]];for(let y=0;y<n;++y,++m,++p){let[_,w]=[e[m],t[m]];e[m]=e[p],t[m]=t[p],e[p]=_,t[p]=w}}for(let u=1;u<a;u*=2){let m=a/(2*u);for(let p=0;p<a;p+=2*u)for(let y=0;y<u;++y){let _=c[y*m],w=o*h[y*m],E=r+i*(p+y),x=E+i*u;for(let M=0;M<n;++M,++E,++x){let S=e[x]*_-t[x]*w,F=e[x]*w+t[x]*_;e[x]=e[E]-S,t[x]=t[E]-F,e[E]+=S,t[E]+=F}}}}};var s0=30;function cu({min_depth:s,few_slices:e,many_slices:t,max_ratio:r,max_depth:i,least_floor_depth:n,depth_step:o},a,l){let c=Math.ceil(Math.min(l,i)/o-1e-6)*o,h=Math.min(a,Math.max(c,n)),u=h<=s*r**(e-1)?e:t;return Array.from({length:u},(m,p)=>s*(h/s)**(p/(u-1)))}var Hi=class{constructor(e,t){this.spec=e;this.depths=t;let r=e.n_nodes,[i,,n]=e.covariance,o=Math.sqrt(.5*(i+n))*r/e.edge;this.fourier=new Wi(r),[this.slopes,this.pair]=[No(r),No(r)],[this.lights,this.traces,this.squares]=[0,1,2].map(()=>new Float32Array(r*r)),this.maps=t.map(()=>new Float32Array(r*r)),this.blurs=t.map(a=>a*o),this.blurs.forEach((a,l)=>{a>=e.maps.least_blur&&this.transfers.set(l,i0(e,t[l]))})}spec;depths;fourier;slopes;pair;lights;traces;squares;maps;blurs;transfers=new Map;compute(e,t){let{spec:r,maps:i,transfers:n}=this;yc(e,r.edge,r.n_nodes,t,this.slopes),this.fourier.transform(this.slopes,1),this.refractAll(),this.computeSpreads();let{max_spread:o,smooth_blur:a}=r.maps;this.depths.forEach((c,h)=>{let u=this.blurs[h]<a?o:1/0;this.deposit(i[h],c*r.n_nodes/r.edge,u)});let l=[...n.keys()];for(let c=0;c<l.length;c+=2){let[h,u]=[l[c],l[Math.min(c+1,l.length-1)]];this.blur(i[h],i[u],n.get(h),n.get(u))}for(let c of i)for(let h=0;h<c.length;++h)c[h]-=1;return i}refractAll(){let{reals:e,imaginaries:t}=this.slopes,{lights:r}=this,{sun:[i,n,o],drift:[a,l],index:c}=this.spec,h=0;for(let m=0;m<r.length;++m){let[p,y]=[e[m],t[m]],_=1/Math.sqrt(1+p*p+y*y),w=Math.max(o-i*p-n*y,0),E=w*_,x=Math.sqrt(1-(1-E*E)/(c*c)),M=(E/c-x)*_,S=1/(o/c-M),F=(E-c*x)/(E+c*x),L=(x-c*E)/(x+c*E);e[m]=(-i/c-M*p)*S-a,t[m]=(-n/c-M*y)*S-l,r[m]=w*(2-F*F-L*L),h+=r[m]}let u=r.length/h;for(let m=0;m<r.length;++m)r[m]*=u}computeSpreads(){let{traces:e,squares:t,slopes:r}=this,{reals:i,imaginaries:n}=r,o=this.spec.n_nodes,a=o-1;for(let l=0,c=0;l<o;++l){let h=(l-1&a)*o,u=(l+1&a)*o;for(let m=0;m<o;++m,++c){let p=l*o+(m-1&a),y=l*o+(m+1&a),_=.5*(i[y]-i[p]),w=.5*(n[y]-n[p]),E=.5*(i[u+m]-i[h+m]),x=.5*(n[u+m]-n[h+m]);e[c]=_+x,t[c]=_*_+w*w+E*E+x*x}}}deposit(e,t,r){let{lights:i,traces:n,squares:o,slopes:a}=this,{reals:l,imaginaries:c}=a,h=this.spec.n_nodes;e.fill(0);for(let u=0,m=0;u<h;++u)for(let p=0;p<h;++p,++m){let y=p+t*l[m],_=u+t*c[m];2+t*(2*n[m]+t*o[m])<r?n0(e,h,y,_,i[m]):this.addTents(e,t,u,p,y,_)}}addTents(e,t,r,i,n,o){let{reals:a,imaginaries:l}=this.slopes,c=this.spec.n_nodes,h=c-1,u=r*c+(i-1&h),m=r*c+(i+1&h),p=(r-1&h)*c+i,y=(r+1&h)*c+i,_=1+.5*t*(a[m]-a[u]),w=.5*t*(l[m]-l[u]),E=.5*t*(a[y]-a[p]),x=1+.5*t*(l[y]-l[p]),M=.25*this.lights[r*c+i];for(let S=0;S<4;++S){let F=S&1?.25:-.25,L=S&2?.25:-.25,C=n+F*_+L*E,U=o+F*w+L*x,V=Math.floor(C),N=Math.floor(U),R=C-V,H=U-N,z=(N&h)*c,j=(N+1&h)*c,W=V+1&h;e[z+(V&h)]+=M*(1-H)*(1-R),e[z+W]+=M*(1-H)*R,e[j+(V&h)]+=M*H*(1-R),e[j+W]+=M*H*R}}blur(e,t,r,i){let{pair:n,fourier:o}=this,{reals:a,imaginaries:l}=n,{n:c}=o,h=c-1;a.set(e),l.set(t),o.transform(n,-1);for(let u=0;u<c;++u)for(let m=0;m<c;++m){let p=u*c+m,y=(-u&h)*c+(-m&h);if(y<p)continue;let _=.5*(r[p]+i[p]),w=.5*(r[p]-i[p]),[E,x,M,S]=[a[p],l[p],a[y],l[y]];a[p]=_*E+w*M,l[p]=_*x-w*S,a[y]=_*M+w*E,l[y]=_*S-w*x}o.transform(n,1),e.set(a),t.set(l)}};function i0({edge:s,n_nodes:e,covariance:[t,r,i],maps:n},o){let a=2*Math.PI/s,l=(n.map_blur*s/e)**2,c=new Float32Array(e*e);for(let h=0;h<e;++h)for(let u=0;u<e;++u){let[m,p]=[u,h].map(w=>a*(w<e/2?w:w-e)),y=t*m*m+2*r*m*p+i*p*p,_=.5*(o*o*y+l*(m*m+p*p));c[h*e+u]=Math.exp(-Math.min(_,s0))/(e*e)}return c}function n0(s,e,t,r,i){let n=e-1,o=Math.floor(t+.5),a=Math.floor(r+.5),l=t-o,c=r-a,h=.5*(.5-l)*(.5-l),u=.75-l*l,m=.5*(.5+l)*(.5+l),p=o-1&n,y=o&n,_=o+1&n,w=i*.5*(.5-c)*(.5-c),E=(a-1&n)*e;s[E+p]+=w*h,s[E+y]+=w*u,s[E+_]+=w*m,w=i*(.75-c*c),E=(a&n)*e,s[E+p]+=w*h,s[E+y]+=w*u,s[E+_]+=w*m,w=i*.5*(.5+c)*(.5+c),E=(a+1&n)*e,s[E+p]+=w*h,s[E+y]+=w*u,s[E+_]+=w*m}function fu({swell:{n_points:s,spacing:e},matrix:[t,r,i,n],wave_lengths:o},{waves:a,time:l,scale:c},h){let u=new Float32Array(4*s*s),{amplitude:m,omega:p,kx:y,ky:_,phase:w}=a,E=new Float64Array(5*s*s);for(let x=0;x<m.length;++x){let[M,S]=[y[x],_[x]];if(2*Math.PI/Math.hypot(M,S)<o[1])continue;let F=c*m[x],L=w[x]+M*h[0]+S*h[1]-p[x]*l;for(let C=0,U=0;C<s;++C)for(let V=0;V<s;++V,U+=5){let N=L+e*(M*V+S*C),[R,H]=[-F*Math.cos(N),-F*Math.sin(N)];E[U]+=M*H,E[U+1]+=S*H,E[U+2]+=M*M*R,E[U+3]+=M*S*R,E[U+4]+=S*S*R}}for(let x=0,M=0;x<E.length;x+=5,M+=4){let[S,F,L,C,U]=E.subarray(x,x+5);u[M]=t*S+r*F,u[M+1]=i*S+n*F,u[M+2]=t*L+(r+i)*C+n*U,u[M+3]=(t*n-r*i)*(L*U-C*C)}return u}var o0=.2,a0=.3,Yi=class{constructor(e,t,r){this.gl=e;this.spec=t;this.format=r;this.swell=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.swell),e.texStorage2D(e.TEXTURE_2D,1,r,t.swell.n_points,t.swell.n_points),this.setFilter(e.TEXTURE_2D,e.LINEAR,e.CLAMP_TO_EDGE)}gl;spec;format;maps=new Map;swell;mapper=null;mapKey=null;nextUpdate=0;swellKey=[];corner=[0,0];prepare(e,t,r,i,n,o){this.updateMaps(e,r,o),e.waves&&this.updateSwell(e,i,n);let{gl:a}=this;return a.activeTexture(a.TEXTURE0+J.caustic_maps),a.bindTexture(a.TEXTURE_2D_ARRAY,this.maps.get(uu(r.length))),a.activeTexture(a.TEXTURE0+J.swell_map),a.bindTexture(a.TEXTURE_2D,this.swell),a.activeTexture(a.TEXTURE0),this.blockValues(t,r,i,n)}updateMaps({tile:e,time:t},r,i){let n=r.join();this.mapper?.depths!==n&&(this.mapper={depths:n,mapper:new Hi(this.spec,r)});let{mapper:o}=this.mapper,a=this.mapKey?.mapper===o&&this.mapKey.tile===e?Math.abs(t-this.mapKey.time):1/0,l=performance.now();if(a===0||!i&&a<=o0&&l<this.nextUpdate)return;this.mapKey={mapper:o,tile:e,time:t},this.upload(o.compute(e,t));let c=performance.now();this.nextUpdate=c+(c-l)*(1/a0-1)}upload(e){let{gl:t,format:r}=this,i=this.spec.n_nodes,n=uu(e.length);t.activeTexture(t.TEXTURE0+J.caustic_maps);let o=this.maps.get(n)??t.createTexture();t.bindTexture(t.TEXTURE_2D_ARRAY,o),this.maps.has(n)||(this.maps.set(n,o),t.texStorage3D(t.TEXTURE_2D_ARRAY,Math.log2(i)+1,r,i,i,n),this.setFilter(t.TEXTURE_2D_ARRAY,t.LINEAR_MIPMAP_LINEAR,t.REPEAT));let a=new Float32Array(4*i*i*n);for(let l=0;l<n;++l)for(let c=0;c<4;++c){let h=e[2*l+c];for(let u=0,m=4*i*i*l+c;u<h.length;++u,m+=4)a[m]=h[u]}t.texSubImage3D(t.TEXTURE_2D_ARRAY,0,0,0,0,i,i,n,t.RGBA,t.FLOAT,a),t.generateMipmap(t.TEXTURE_2D_ARRAY),t.activeTexture(t.TEXTURE0)}updateSwell(e,t,r){let{gl:i,spec:n}=this,{n_points:o,spacing:a}=n.swell,l=de(t),c=Math.max(r-l[2],0),h=[0,1].map(p=>a*Math.floor((l[p]-c*n.drift[p])/a-.5*o)),u=[e.waves,e.time,e.scale,...h];if(u.every((p,y)=>p===this.swellKey[y]))return;[this.swellKey,this.corner]=[u,h];let m=fu(n,e,h);i.activeTexture(i.TEXTURE0+J.swell_map),i.bindTexture(i.TEXTURE_2D,this.swell),i.texSubImage2D(i.TEXTURE_2D,0,0,0,o,o,i.RGBA,i.FLOAT,m),i.activeTexture(i.TEXTURE0)}blockValues({loss:e,shafts:t},r,i,n){let{edge:o,drift:a,swell:l,n_nodes:c}=this.spec,h=n-i[11],u=l.n_points*l.spacing/o,m=[0,0,1/u,1/o],p=[0,1].flatMap(_=>{let w=(i[4*_+3]-a[_]*h)/o,E=Math.floor(w);return m[_]=.5/l.n_points-(this.corner[_]/o-E)/u,[...[0,1,2].map(x=>(i[4*_+x]+a[_]*i[8+x])/o),w-E]}),y=Math.log2(r[1]/r[0]);return Float32Array.from([...p,...m,r[0],1/y,-Math.log2(r[0])/y,r.at(-1),...e,...t,c])}setFilter(e,t,r){let{gl:i}=this;for(let[n,o]of[[i.TEXTURE_MIN_FILTER,t],[i.TEXTURE_MAG_FILTER,i.LINEAR],[i.TEXTURE_WRAP_S,r],[i.TEXTURE_WRAP_T,r]])i.texParameteri(e,n,o)}};function uu(s){return s/2-1}var qi=class{constructor(e,t,r){this.spec=t;this.caustics=new Yi(e,t,r)}spec;caustics;prepare({focusing:e,worldFromCamera:t,water:r,isExact:i},n,o){let{spec:a,caustics:l}=this,c=n.caustics;if(!c||!e)return null;let h=cu(a.maps,c.lost_depth,r.surface_height-o),u=l.prepare(e,c,h,t,r.surface_height,i===!0),m={N_SLICES:h.length,...e.waves?{SWELL:1}:{}};return{values:u,surfaces:a.has_caustics?{CAUSTICS:1,...m}:{},shafts:a.shafts&&{...a.shafts,...m}}}};var Cs=128,l0=[-1,-.32,10,-3,.45],hu=[4,-.7],[c0,mu]=[50,154],f0=[.2126,.7152,.0722],u0=[[3.2406,-1.5372,-.4986],[-.9689,1.8758,.0415],[.0557,-.204,1.057]],h0=.01;function du(s,e,t){let r=Cs,i=new Float32Array(8*r*r),n=Lo(s,0,t,!0);for(let o=0;o<r;++o)for(let a=0;a<r;++a){let[l,c]=[a,o].map(_=>2*_/(r-1)-1),h=Math.hypot(l,c),u=Math.min(h*h,1),m=2/(1+u)/Math.max(h,1),p=[m*l,m*c,(1-u)/(1+u)],y=4*(r*o+a);i.set(m0(e,p).map(_=>t*_),y),i.set(n([p[0],p[1],-p[2]]),4*r*r+y)}return i}function m0(s,e){let t=Math.max(e[2],h0),r=Math.min(Math.max(le(e,s.sun),-1),1),[i,n,o,a,l]=l0,c=1+i*Math.exp(n/t),h=1+o*(Math.exp(a*Math.acos(r))-Math.exp(a*Math.PI/2))+l*r*r,u=s.clear*c*h,m=s.overcast*(1+hu[0]*Math.exp(hu[1]/t));return d0(mu+(c0-mu)*Math.sqrt(t)).map(p=>u*p+m)}function d0(s){let e=s*.001,t=.244063+e*(.09911+e*(2.9678-e*4.607)),r=.23704+e*(.24748+e*(1.9018-e*2.0064)),i=s>1e6/7e3?t:r,n=-3*i*i+2.87*i-.275,o=u0.map(l=>Math.max(le(l,[i/n,1,(1-i-n)/n]),0)),a=le(o,f0);return o.map(l=>l/a)}var ar=128,pu=[.2,.8,3.2,12.8],Oo=192,gu=[.2,.4,.8,1.6],p0=4,g0=6,v0=.25,y0=4.5,bu=9.81,Xi=class{constructor(e,t,r){this.gl=e;this.programs=t;this.format=r;this.textures=[e.createTexture(),e.createTexture()];for(let i of this.textures){e.bindTexture(e.TEXTURE_2D,i);for(let n of[e.TEXTURE_MIN_FILTER,e.TEXTURE_MAG_FILTER])e.texParameteri(e.TEXTURE_2D,n,e.NEAREST)}}gl;programs;format;textures;texture(e,t,r){let{gl:i}=this,n=r?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D,o=i.createTexture();i.bindTexture(n,o),r?i.texStorage3D(n,1,this.format,e,e,r):i.texStorage2D(n,1,this.format,e,e);for(let l of[i.TEXTURE_MIN_FILTER,i.TEXTURE_MAG_FILTER])i.texParameteri(n,l,i.LINEAR);for(let l of[i.TEXTURE_WRAP_S,i.TEXTURE_WRAP_T])i.texParameteri(n,l,t);let a=Array.from({length:r??1},(l,c)=>{let h=i.createFramebuffer();return i.bindFramebuffer(i.FRAMEBUFFER,h),r?i.framebufferTextureLayer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,o,0,c):i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,n,o,0),h});return{texture:o,buffers:a}}draw({amplitude:e,omega:t,kx:r,ky:i,phase:n},[o,a],l,c,h,u){let{gl:m}=this,p=Math.max(e.length,1),[y,_]=[0,1].map(()=>new Float32Array(4*p*h));for(let w=0;w<e.length;++w){let E=r[w]*o+i[w]*a-t[w]*c+n[w],x=t[w]*t[w]/bu,M=4*h*w;vu(y,M,h,1,E,r[w]*l,[r[w],x]),vu(_,M,h,e[w],0,i[w]*l,[i[w],0])}[y,_].forEach((w,E)=>{m.activeTexture(m.TEXTURE0+[J.factors_x,J.factors_y][E]),m.bindTexture(m.TEXTURE_2D,this.textures[E]),m.texImage2D(m.TEXTURE_2D,0,m.RGBA32F,h,p,0,m.RGBA,m.FLOAT,w)}),m.activeTexture(m.TEXTURE0),m.bindFramebuffer(m.FRAMEBUFFER,u),m.viewport(0,0,h,h),m.disable(m.DEPTH_TEST),m.disable(m.CULL_FACE),m.disable(m.BLEND),m.bindVertexArray(null),m.useProgram(this.programs.get("wave_grid",{},"screen")),m.drawArrays(m.TRIANGLES,0,3)}},ji=class{constructor(e,t){this.sums=t;this.grids=t.texture(ar,e.CLAMP_TO_EDGE,pu.length),this.nearGrid=t.texture(Oo,e.CLAMP_TO_EDGE)}sums;grids;nearGrid;frames=[];maxElevation=0;slopeVariance=0;hasFoam=!1;components=null;scale=1;keys=new Map;set(e,t){if(e===this.components&&t===this.scale||([this.components,this.scale]=[e,t],this.frames=[],this.keys.clear(),[this.maxElevation,this.slopeVariance,this.hasFoam]=[0,0,!1],!e))return;let r=[...e.amplitude].map(n=>t*n),i=r.map((n,o)=>n*e.omega[o]**2/bu);this.maxElevation=_u(r,g0),this.slopeVariance=yu(e,t,()=>!0),this.hasFoam=_u(i,y0)>v0}update(e,t){this.frames=pu.map((r,i)=>this.draw(e,t,r,ar,this.grids.buffers[i]))}updateNear(e,t,r){let i=r/(.5*Oo-2),n=gu.find(o=>o>=i)??gu.at(-1);this.frames=[this.draw(e,t,n,Oo,this.nearGrid.buffers[0])]}draw(e,t,r,i,n){let o=this.components,a=u=>u*p0*r<=2*Math.PI,l=[0,1].map(u=>r*(Math.floor(t[u]/r+.5)-i/2)),c=`${e} ${r} ${l}`;this.keys.get(n)!==c&&(this.keys.set(n,c),this.sums.draw(_0(o,this.scale,a),l,r,e,i,n));let h=yu(o,this.scale,u=>!a(u));return{origin:l,spacing:r,nPoints:i,roughness:h}}};function vu(s,e,t,r,i,n,o){let[a,l]=[r*Math.cos(i),r*Math.sin(i)],[c,h]=[Math.cos(n),Math.sin(n)];for(let u=e;u<e+4*t;u+=4){s[u]=a,s[u+1]=l,s[u+2]=o[0],s[u+3]=o[1];let m=a*c-l*h;l=l*c+a*h,a=m}}function _0({amplitude:s,omega:e,kx:t,ky:r,phase:i},n,o){let a=(p,y)=>o(Math.hypot(t[y],r[y])),[l,c,h,u,m]=[s,e,t,r,i].map(p=>p.filter(a));return{amplitude:l.map(p=>n*p),omega:c,kx:h,ky:u,phase:m}}function yu({amplitude:s,kx:e,ky:t},r,i){let n=0;for(let o=0;o<s.length;++o){let a=Math.hypot(e[o],t[o]);i(a)&&(n+=.25*(r*s[o]*a)**2)}return n}function _u(s,e){let t=s.reduce((i,n)=>i+n*n,0),r=s.reduce((i,n)=>i+n,0);return Math.min(r,e*Math.sqrt(.5*t))}var lr=5.3,wu=2,[xu,Eu]=[.55,.43],b0=.00465,w0=1.34,x0=96;function Au(s,e,t,r,i,n,o,a){let l=de(n),c=Se([n[0],n[1],n[2],0,n[4],n[5],n[6],0,n[8],n[9],n[10],0,0,0,0,1]),h=Se([n[0],n[4],n[8],0,n[1],n[5],n[9],0,n[2],n[6],n[10],0,0,0,0,1]),u=E=>E.map(x=>a*x),m=[0,1,2,3].map(E=>{let x=t.frames[E];if(!x)return[0,0,0,0];let{origin:M,spacing:S,nPoints:F}=x;return[...[0,1].map(C=>((l[C]-M[C])/S+.5)/F),1/(S*F),S]}),[p,y]=[Math.cos(xu)/Eu,Math.sin(xu)/Eu],_=[p*l[0]-y*l[1],y*l[0]+p*l[1]],w=new Float32Array(x0);return w.set([...xt(Ie(rr(o,!0),h)),...xt(c),r,o.near,0,t.frames.length,...m.flat(),...[0,1,2,3].map(E=>t.frames[E]?.roughness??0),Math.sqrt(i/wu),i/wu,1/lr,lr/ar,Ki(l[0],5*lr),Ki(l[1],5*lr),0,0,Ki(_[0],lr),Ki(_[1],lr),p,y,t.maxElevation,t.slopeVariance,0,0,...s.sky.sun,b0,...u(s.sky.sunlight),e.sun[2],...u(s.sky.light),0,...e.reflectance.map((E,x)=>a*E*e.total[x]),0,o.width,o.height,0,0,s.air,w0,1/Math.sqrt(o.fx*o.fy),0]),w}function Ki(s,e){return s-e*Math.floor(s/e)}var Tr=32,$i=8,[E0,Su,Do]=[.2,1500,2e5],A0=170,Mu=12,Qi=class{constructor(e){this.gl=e;let t=this.radii=R0(),r=Tr*$i,i=r+1,n=t.flatMap(a=>Array.from({length:i},(l,c)=>2*Math.PI*c/r).flatMap(l=>[a*Math.cos(l),a*Math.sin(l)])),o=[];for(let a=0;a<Tr;++a)for(let l=0;l<t.length-1;++l)for(let c=0;c<$i;++c){let h=i*l+$i*a+c,u=h+i;o.push(h,u,u+1,h,u+1,h+1)}this.vertexArray=e.createVertexArray(),e.bindVertexArray(this.vertexArray),e.bindBuffer(e.ARRAY_BUFFER,e.createBuffer()),e.bufferData(e.ARRAY_BUFFER,Float32Array.from(n),e.STATIC_DRAW),e.enableVertexAttribArray(Ft.vertex),e.vertexAttribPointer(Ft.vertex,2,e.FLOAT,!1,0,0),e.bindBuffer(e.ELEMENT_ARRAY_BUFFER,e.createBuffer()),e.bufferData(e.ELEMENT_ARRAY_BUFFER,Uint32Array.from(o),e.STATIC_DRAW),e.bindVertexArray(null)}gl;vertexArray;radii;draw({sectors:e,minRadius:t,maxRadius:r}){let{gl:i,radii:n}=this,o=6*$i,a=Math.max(Tu(n,t)-2,0),l=Math.min(Tu(n,r)+1,n.length-1)-a;if(!(l<=0)){i.bindVertexArray(this.vertexArray);for(let c of e){let h=c*(n.length-1)*o+a*o;i.drawElements(i.TRIANGLES,l*o,i.UNSIGNED_INT,4*h)}i.bindVertexArray(null)}}};function Ru(s,e,t,r){let i=S0(e).map(([_,w])=>{let E=-(w-e.cy)/e.fy;return Xr(s,[(_-e.cx-e.skew*E)/e.fx,E,-1])}),n=T0(s,e),o=n?Array.from({length:Tr},(_,w)=>w):M0(s,i),a=t>0?-1:1,[l,c]=[Math.abs(t)-r,Math.abs(t)+r],h=i.map(([_,w,E])=>a*E/Math.hypot(_,w)),[u,m]=[1.05*Math.max(...h),.95*Math.min(...h)],[p,y]=[0,Do];if(l>0){!n&&u<=0&&(o=[]),n||(p=l/Math.max(u,1e-9));let _=a*s[10]<0;m>0&&(!n||_)&&(y=Math.min(c/m,Do))}return{sectors:o,minRadius:p,maxRadius:y}}function S0({width:s,height:e}){return Array.from({length:Mu},(t,r)=>r/(Mu-1)).flatMap(t=>{let[r,i]=[s*t-.5,e*t-.5];return[[r,-.5],[r,e-.5],[-.5,i],[s-.5,i]]})}function M0(s,e){let t=Math.atan2(-s[6],-s[2]),r=e.map(([l,c])=>{let h=Math.atan2(c,l)-t;return h-2*Math.PI*Math.floor(h/(2*Math.PI)+.5)}),i=2*Math.PI/Tr,n=Math.floor((t+Math.min(...r))/i-.25),o=Math.floor((t+Math.max(...r))/i+.25),a=new Set;for(let l=n;l<=o;++l)a.add((l%Tr+Tr)%Tr);return[...a].sort((l,c)=>l-c)}function T0(s,e){return[1,-1].some(t=>{let[r,i,n]=[t*s[8],t*s[9],t*s[10]];if(n>=-1e-6)return!1;let o=e.fx*r/-n+e.skew*i/-n+e.cx,a=-e.fy*i/-n+e.cy,l=.1*e.width;return-l<=o&&o<=e.width+l&&-l<=a&&a<=e.height+l})}function Tu(s,e){let t=s.findIndex(r=>r>=e);return t<0?s.length:t}function R0(){let s=(e,t,r)=>Array.from({length:r},(i,n)=>e*(t/e)**(n/(r-1)));return[0,...s(E0,Su,A0),...s(Su,Do,16).slice(1)]}var P0=.01,Ji=class{constructor(e,t,r,i,n){this.gl=e;this.programs=t;this.spec=r;this.formatSwitches=n;this.sums=new Xi(e,t,i),this.grids=new ji(e,this.sums),this.ripples=this.sums.texture(ar,e.REPEAT),this.hemispheres=e.createTexture(),e.bindTexture(e.TEXTURE_2D_ARRAY,this.hemispheres),e.texStorage3D(e.TEXTURE_2D_ARRAY,1,i,Cs,Cs,2);for(let[o,a]of[[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D_ARRAY,o,a);this.mesh=new Qi(e)}gl;programs;spec;formatSwitches;sums;grids;ripples;hemispheres;mesh;ripplesKey=[];hemispheresKey=[];switches={};sides=[];view={sectors:[],minRadius:0,maxRadius:0};prepare({time:e,scale:t,waves:r,ripples:i},n,o,a,l,c){let{grids:h,spec:u}=this;h.set(r,t);let m=de(a),p=m[2]-o,y=h.maxElevation+2*l.near;this.sides=[...p>-y?[!0]:[],...p<y?[!1]:[]],this.view=Ru(a,l,p,y),this.isDirect&&(this.view.maxRadius=Math.min(this.view.maxRadius,L0(n))),this.switches={...this.formatSwitches};let _=0;r&&this.view.sectors.length&&(_=h.slopeVariance,this.isDirect?h.updateNear(e,m,this.view.maxRadius):h.update(e,m),this.switches.WAVES=h.frames.length,h.hasFoam&&(this.switches.FOAM=1));let w=i?Math.max(u.slope_variance-_,0):0;return i&&w>0&&((this.ripplesKey[0]!==i||this.ripplesKey[1]!==e)&&(this.ripplesKey=[i,e],this.sums.draw(i,[0,0],lr/ar,e,ar,this.ripples.buffers[0])),this.switches.RIPPLES=1),this.updateHemispheres(n,c),Au(u,n,h,p,w,a,l,c)}get isDirect(){return this.sides.length===1&&!this.sides[0]}drawAmong(){this.useTextures(),this.drawSides({DIRECT:1}),this.gl.depthFunc(this.gl.LEQUAL)}draw(e){let{gl:t}=this;this.useTextures(),t.disable(t.DEPTH_TEST),t.disable(t.CULL_FACE),t.bindVertexArray(null),t.useProgram(this.programs.get("air",this.switches,"screen")),t.drawArrays(t.TRIANGLES,0,3),t.enable(t.DEPTH_TEST),t.depthFunc(t.LESS),this.drawSides(e?{BODIES_ABOVE:1}:{}),t.depthFunc(t.LEQUAL)}drawSides(e){let{gl:t}=this;t.enable(t.CULL_FACE),t.frontFace(t.CW);for(let r of this.sides){t.cullFace(r?t.BACK:t.FRONT);let i=r?{ABOVE:1}:{};t.useProgram(this.programs.get("water_surface",{...this.switches,...e,...i})),this.mesh.draw(this.view)}t.cullFace(t.BACK),t.disable(t.CULL_FACE)}useTextures(){let{gl:e}=this;for(let[t,r,i]of[[J.wave_grids,e.TEXTURE_2D_ARRAY,this.grids.grids.texture],[J.wave_grid,e.TEXTURE_2D,this.grids.nearGrid.texture],[J.ripple_tile,e.TEXTURE_2D,this.ripples.texture],[J.hemispheres,e.TEXTURE_2D_ARRAY,this.hemispheres]])e.activeTexture(e.TEXTURE0+t),e.bindTexture(r,i);e.activeTexture(e.TEXTURE0)}updateHemispheres(e,t){let{gl:r}=this,i=[e.transform,t];if(i.every((a,l)=>a===this.hemispheresKey[l]))return;this.hemispheresKey=i;let n=du(e,this.spec.sky,t);r.activeTexture(r.TEXTURE0+J.hemispheres),r.bindTexture(r.TEXTURE_2D_ARRAY,this.hemispheres);let o=Cs;r.texSubImage3D(r.TEXTURE_2D_ARRAY,0,0,0,0,o,o,2,r.RGBA,r.FLOAT,n),r.activeTexture(r.TEXTURE0)}};function L0({absorption:s,scattering:e,field:t}){let r=Array.from({length:48},(n,o)=>2*1.25**o),i=r.filter(n=>s.some((o,a)=>{let l=t[0]+t[1]*Math.sqrt(o*n);return Math.exp(-n*(o+l*e[a]))>P0}));return i.length?i.at(-1)*1.25:r[0]}function Pu({worldFromCamera:s,intrinsics:e,water:t,optics:r},i,n,o,a){let{near:l,far:c}=e,{ambient:h,specular:u,suns:m}=i,p=t.light_rate,y=r?.absorption.map((M,S)=>M+r.scattering[S])??t.attenuation,_=t.follows_light===!1?1:p,[w,E]=[t.colour,t.fog_colour].map(M=>M.map(S=>_*S)),x=t.fog>0?E:w;return Float32Array.from([...xt(n),...xt(Ie(a.textureFromWorld,s)),s[8],s[9],s[10],de(s)[2]-t.surface_height,...Xs(s,o),a.lift,...m[t.sun].colour.map(M=>p*M),0,p*h,p*u,0,0,...w,0,...y,0,...E,t.fog**2,(c+l)/(c-l),-2*c*l/(c-l),0,0,...x,0])}var Uo=256,Zi=class{constructor(e,t){this.gl=e;this.models=t;this.values=new Float32Array(Uo/4*Math.max(1,t.instances.length)),this.buffer=e.createBuffer()}gl;models;values;buffer;fill(e,t){this.models.instances.forEach((r,i)=>{let n=Uo/4*i;this.values.set(xt(Ie(e,r.worldFromMesh)),n),t&&this.values.set(xt(Ie(t,r.normals)),n+16)}),this.gl.bindBuffer(this.gl.UNIFORM_BUFFER,this.buffer),this.gl.bufferData(this.gl.UNIFORM_BUFFER,this.values,this.gl.STREAM_DRAW)}drawPiece({instance:e,firstIndex:t,count:r},i){let n=this.gl;e.visual.two_sided?n.disable(n.CULL_FACE):n.enable(n.CULL_FACE),n.frontFace(e.isMirrored!==i?n.CW:n.CCW),n.bindBufferRange(n.UNIFORM_BUFFER,jt.Instance,this.buffer,Uo*e.index,160),n.bindVertexArray(e.vertexArray);let[o,a]=e.hasUint32Indices?[n.UNSIGNED_INT,4]:[n.UNSIGNED_SHORT,2];n.drawElements(n.TRIANGLES,r,o,a*t)}};var Lu=5,I0=320*240,Iu=4;function Ns(s){let e=s.getExtension("WEBGL_debug_renderer_info"),t=e?String(s.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return/swiftshader|llvmpipe|software|softpipe/i.test(t)}var en=class{constructor(e,t,r){this.gl=e;this.head=t;this.models=r;this.isSoftware=Ns(e),this.programs=new Ri(e),this.instanceBlocks=new Zi(e,r),this.shadows=new Ci(e,this.programs,this.instanceBlocks);let{nodes:i}=t.water;this.development=i?Gi.make(e,this.programs,i):null,this.surfacePass=t.surface&&this.development?new Ji(e,this.programs,t.surface,this.development.format,this.development.switches):null,this.focusedLight=t.caustics&&this.development?new qi(e,t.caustics,this.development.format):null,this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(n=>{let o=e.createSampler();return e.samplerParameteri(o,e.TEXTURE_MIN_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_WRAP_S,n),e.samplerParameteri(o,e.TEXTURE_WRAP_T,n),o})}gl;head;models;isSoftware;programs;instanceBlocks;shadows;blocks={};samplers;development;surfacePass;focusedLight;get lacksFloats(){return!!this.head.water.nodes&&!this.development}draw(e,t,r,i=!1){e.optics&&this.development?this.drawPhysical(e,e.optics,t,r,i):this.drawSurfaces(e,t,r,i,{})}drawPhysical(e,t,r,i,n){let o=this.development,{worldFromCamera:a,water:l}=e,c=this.isSoftware&&!e.isExact,h=this.isSoftware||e.isExact||devicePixelRatio>=2?1:2,u=_s(e.intrinsics,h),m=u.width*u.height>I0,p=o.plan(u,t.blur&&!(c&&m)),y=e.lamps.slice(0,Iu),_=l.surface_height-de(a)[2],w=e.surface?this.surfacePass:null;if(w){let V=w.prepare(e.surface,t,l.surface_height,a,u,l.light_rate);this.fill("Surface",V)}let E=o.prepare(t,a,u,p,_,l.light_rate,w!==null);this.fill("Optics",Bf(t,u,y,l.light_rate,p.reach));let x=w?.isDirect,M=this.focusedLight?.prepare(e,t,Ff(this.models,Lu))??null;M&&this.fill("Caustics",M.values);let S={PHYSICAL:1,...w?{SKY:1}:{},...o.switches,...M?.surfaces};if(this.drawSurfaces({...e,intrinsics:u,grey:!1},E,[0,0],!0,S,()=>x&&w.drawAmong()),y.length&&this.drawLampPoints(y.length,o.switches),w&&!x){let V=({corners:N})=>N.some(R=>R[2]>l.surface_height);o.drawOver(()=>w.draw(this.shownPieces(e).some(V)))}this.gl.disable(this.gl.DEPTH_TEST);let F=au(this.head.particles,e,u),L=lu(this.head.particles,e),C=e.grey===!0,U=o.develop(t,u,p,y.length,C,F,L,M?.shafts??null);o.present(U,r,i,e.intrinsics,n)}drawLampPoints(e,t){let{gl:r}=this;r.useProgram(this.programs.get("lamp_point",{COLOUR:0,LAMPS:e,...t})),r.depthMask(!1),r.enable(r.BLEND),r.blendFuncSeparate(r.ONE,r.ONE,r.ONE,r.ZERO),r.drawArrays(r.POINTS,0,e),r.disable(r.BLEND),r.depthMask(!0)}drawSurfaces(e,t,r,i,n,o=()=>{}){let{gl:a}=this,{worldFromCamera:l,intrinsics:c,water:h}=e,u=rr(c,i),m={worldFromCamera:l,clip:u,intrinsics:c},p=this.shownPieces(e),y=ki(p,m),_={COLOUR:0,...n},w=h.fog>0;!n.PHYSICAL&&!w&&(_.NO_FOG=1),!n.PHYSICAL&&w&&h.clip&&!e.isExternal&&(_.FOG_CLIP=1),e.grey&&(_.GREY=1),e.isExternal&&Object.assign(_,n.SKY?{POLISHED:1}:{AIR:1,POLISHED:1}),e.isExternal&&!this.isSoftware&&(_.SOFT=1);let E=n.PHYSICAL?e.optics.sun:wt(this.head.suns[h.sun].direction);h.shadows&&this.updateSunShadows(p,y,E,m)&&(_.SHADOWS=1),this.lightScene(e,p,_),this.fill("Frame",Pu(e,this.head,u,E,this.shadows)),this.instanceBlocks.fill(Ze(l),k0(l)),a.bindFramebuffer(a.FRAMEBUFFER,t),a.viewport(r[0],r[1],c.width,c.height),a.enable(a.SCISSOR_TEST),a.scissor(r[0],r[1],c.width,c.height),a.depthMask(!0),a.clear(a.DEPTH_BUFFER_BIT),a.enable(a.DEPTH_TEST),a.depthFunc(a.LEQUAL),a.disable(a.BLEND);for(let M of y.filter(ks))this.drawPiece(M,m,_,i);this.drawBackground(e.grey?{COLOUR:0,GREY:1,...n}:{COLOUR:0,...n}),o(),a.enable(a.BLEND),a.blendFuncSeparate(a.SRC_ALPHA,a.ONE_MINUS_SRC_ALPHA,a.ZERO,a.ONE),a.depthMask(!1);for(let M of y.filter(S=>!ks(S)).reverse()){let S=Math.round(255*M.instance.visual.opacity);S>0&&this.drawPiece(M,m,{..._,OPACITY:S},i)}this.models.maps?.release(),a.depthMask(!0),a.disable(a.BLEND),a.disable(a.SCISSOR_TEST),a.bindVertexArray(null)}shownPieces({isExternal:e}){return this.models.instances.filter(({visual:t})=>e||!t.hidden).flatMap(({pieces:t})=>t)}updateSunShadows(e,t,r,i){let n=e.filter(a=>ks(a)&&this.models.radius(a.instance)<=Lu),o=Pf(n,t,r,i);return o.length&&this.shadows.updateSunShadows(o,r,this.models.version),this.bind(J.shadow_map,this.shadows.sunMap.texture),o.length>0}lightScene(e,t,r){let i=e.lamps.slice(0,Iu);i.length&&(r.LAMPS=i.length,this.shadows.updateLampShadows(i,t,this.models.version),this.bind(J.lamp_maps,this.shadows.lampMaps.texture),this.fill("Lamps",Uf(i,e.worldFromCamera)));let{projector:n}=this.head;if(!n)return;r.PROJECTOR=1;let{width:o,height:a}=this.head.textures[n.pattern],l=this.models.worldFromMount(n),c=Df(n,o,a);this.shadows.updateProjectorShadows(l,c,t),this.bind(J.projector_map,this.shadows.projectorMap.texture),this.bind(J.projector_pattern,this.models.patterns[0]),this.fill("Projector",Vf(n,l,c,e.worldFromCamera))}drawPiece(e,t,r,i){let[{gl:n},{texture:o,repeats:a,visual:l}]=[this,e.instance],c=kf(e,t)?this.samplers:null;o&&(this.bind(J.base_map,o),n.bindSampler(J.base_map,c&&c[Number(a)]));let h=this.models.maps.use(l.material,o?{...r,TEXTURED:1}:r,c);n.useProgram(this.programs.get("surface",h)),this.instanceBlocks.drawPiece(e,i)}drawBackground(e){let{gl:t}=this;t.bindSampler(J.base_map,null),t.disable(t.CULL_FACE),t.bindVertexArray(null),t.useProgram(this.programs.get("background",e)),t.drawArrays(t.TRIANGLES,0,3)}fill(e,t){let{gl:r}=this;this.blocks[e]??=r.createBuffer(),r.bindBuffer(r.UNIFORM_BUFFER,this.blocks[e]),r.bufferData(r.UNIFORM_BUFFER,t,r.STREAM_DRAW),r.bindBufferBase(r.UNIFORM_BUFFER,jt[e],this.blocks[e])}bind(e,t){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,t),this.gl.activeTexture(this.gl.TEXTURE0)}};function k0(s){let e=s;return Se([e[0],e[4],e[8],0,e[1],e[5],e[9],0,e[2],e[6],e[10],0,0,0,0,1])}var F0=150;function ku(s){let e=document.createElement("canvas").getContext("webgl2");if(!e)return null;let t=!Ns(e);return e.getExtension("WEBGL_lose_context")?.loseContext(),s.getContext("webgl2",{alpha:!1,antialias:t,powerPreference:"high-performance"})}var tn=class s{constructor(e,t,r){this.gl=e;this.models=r;let i=this.head=t.head;this.media=new yi(t),this.surfaces=new Ai(t,i),this.focusingSurfaces=new Mi(t,i),this.renderer=e&&new en(e,i,r),this.pacing=e&&Ns(e)?new Ii(e):null;for(let n of i.cameras){let o=K("figure");o.append(K("figcaption",`${n.name} · redrawn, no noise`)),o.style.aspectRatio=`${n.width} / ${n.height}`,G("pictures").append(o),this.frames.push(o)}}gl;models;canvas=G("image");head;overlay=G("overlay");renderer;frames=[];images=[];pacing;media;surfaces;focusingSurfaces;static async make(e,t){return new s(e,t,await Li.load(e,t))}draw(e,t,r,i){let{canvas:n,head:o,models:a}=this,l=this.gl&&Ns(this.gl)?1:Math.min(devicePixelRatio,2),[c,h]=[n.clientWidth,n.clientHeight];if(c===0||h===0)return null;for(let N of[n,this.overlay]){let[R,H]=[Math.round(c*l),Math.round(h*l)];(N.width!==R||N.height!==H)&&([N.width,N.height]=[R,H])}a.place(t.poses),o.sand?.forEach((N,R)=>a.setSand(R,e.sand(R,t.time)));let u=r.viewCamera(c,h),m=this.water(e,t,i),p=this.media.mediumAt(t),y=this.lamps(t),{worldFromCamera:_,isExternal:w}=u,E=_s(u.intrinsics,l),x=u.camera?.grey,M=t.drift(),S=e.puffs(t.time),F=this.surfaces.surfaceAt(e.trial,t),L=this.focusingSurfaces.surfaceAt(e.trial,t),C={worldFromCamera:_,intrinsics:E,water:m,optics:p,lamps:y,isExternal:w,grey:x,drift:M,puffs:S,surface:F,focusing:L},U={...C,water:{...m,fog:0},optics:this.media.clearOptics(p),drift:null};this.renderer?.draw(i.clear?U:C,null,[0,0]);let V=this.overlay.getContext("2d");if(V.setTransform(l,0,0,l,0,0),V.clearRect(0,0,c,h),Tf(V,_,u.intrinsics,o,a,e,t,i),u.camera&&Mo(V,u.camera,u.intrinsics,0,0,t),r.mode==="map"){let N=G("hud");Rf(V,u.intrinsics,r.height,N.offsetTop+N.offsetHeight)}return this.frames.forEach((N,R)=>N.hidden=o.cameras[R]===u.camera),this.drawPictures(V,{...C,isExternal:!1},t,i,l,h),this.pacing?.begin(),u}get lacksFloats(){return this.renderer?.lacksFloats??!1}skipPauses(){this.pacing?.skipPauses()}isReady(){return this.pacing?.isReady(performance.now())??!0}image(e,t,r,i,n,o={}){let{gl:a,models:l,renderer:c}=this;if(!a||!c)return new Uint8Array;l.place(i.poses);let h=a.createFramebuffer();a.bindFramebuffer(a.FRAMEBUFFER,h);let u=[a.createRenderbuffer(),a.createRenderbuffer()];[a.RGBA8,a.DEPTH_COMPONENT24].forEach((x,M)=>{a.bindRenderbuffer(a.RENDERBUFFER,u[M]),a.renderbufferStorage(a.RENDERBUFFER,x,e.width,e.height);let S=M?a.DEPTH_ATTACHMENT:a.COLOR_ATTACHMENT0;a.framebufferRenderbuffer(a.FRAMEBUFFER,S,a.RENDERBUFFER,u[M])});let{isExternal:m=!1,isClear:p,grey:y}=o,_=this.media.mediumAt(i),w={worldFromCamera:t,intrinsics:e,lamps:this.lamps(i),isExternal:m,isExact:!0,grey:y,drift:p?null:i.drift(),puffs:r.puffs(i.time),surface:this.surfaces.surfaceAt(r.trial,i),focusing:this.focusingSurfaces.surfaceAt(r.trial,i),optics:p?this.media.clearOptics(_):_,water:{...this.water(r,i,n),...o.water,...p?{fog:0}:{}}};c.draw(w,h,[0,0],!0);let E=new Uint8Array(4*e.width*e.height);a.readPixels(0,0,e.width,e.height,a.RGBA,a.UNSIGNED_BYTE,E);for(let x of u)a.deleteRenderbuffer(x);return a.deleteFramebuffer(h),E}pictureWidth(){let e=this.head.cameras.map(({width:t,height:r})=>t/r);return Math.round(F0*Math.max(...e)*Math.min(devicePixelRatio,2))}show(e,t){this.frames[e]&&(this.images[e]?this.images[e].close():this.frames[e].querySelector("figcaption").textContent=this.head.cameras[e].name,this.images[e]=t)}drawPictures(e,t,r,i,n,o){if(G("pictures").hidden=!i.pictures,!i.pictures)return;let a=this.canvas.getBoundingClientRect();this.head.cameras.forEach((l,c)=>{if(this.frames[c].hidden)return;let h=this.frames[c].getBoundingClientRect(),[u,m]=[h.left-a.left+1,h.top-a.top+1],p=Eo(l,h.width-2,h.height-2);if(this.images[c])e.drawImage(this.images[c],u,m,h.width-2,h.height-2);else{let y=this.models.worldFromMount(l),_=[Math.round(u*n),Math.round((o-m-h.height+2)*n)],{grey:w}=l,E={...t,worldFromCamera:y,intrinsics:_s(p,n),grey:w};this.renderer?.draw(E,null,_)}Mo(e,l,p,u,m,r)})}water(e,t,r){let i=e.levels[_r(e,t.time)]?.level.values??{},{fog:n,light_rate:o}=this.head.water;return{...this.head.water,fog:t.signal("fog")??i.fog??n,light_rate:t.signal("light_rate")??i.light??o,sun:r.sun||this.head.water.sun}}lamps(e){return this.head.lamps.map((t,r)=>({lamp:t,index:r,brightness:e.signal(`lamp/${t.name}`)??Number(t.on)})).filter(({brightness:t})=>t>0).map(({lamp:t,index:r,brightness:i})=>({index:r,lamp:{...t,intensity:i*t.intensity},worldFromLamp:this.models.worldFromMount(t)}))}};var fs=class{constructor(e,t,r,i={}){this.time=e;for(let[o,a]of Object.entries(i))this.poses.set(o,nt(a));if(!t||!r)return;t.bodies.forEach((o,a)=>this.poses.set(o,nt(r,7*a)));let n=7*t.bodies.length;t.signals.forEach((o,a)=>this.signals.set(o.name,r[n+a]))}time;poses=new Map;signals=new Map;signal(e){let t=this.signals.get(e);return t===void 0||Number.isNaN(t)?void 0:t}drift(){let e=t=>[..."xyz"].map(r=>this.signal(`${t}/${r}`)??0);return{displacement:e("particles"),velocity:e("particle_velocity"),time:this.time}}points(e,t){let r=[];for(let i=0;;++i){if(!this.signals.has(`${e}/${i}/${t[0]}`))return r;let n=t.map(o=>this.signal(`${e}/${i}/${o}`));n.every(o=>o!==void 0)&&r.push(n)}}};var Vo=6,Os=.2,C0=30,N0=1e4,rn=class{constructor(e){this.pack=e;let t=e.head.trials??[];this.levels=t.flatMap(({levels:r},i)=>r.map(n=>({trial:i,level:n})))}pack;isLive=!1;levels;curves=[];trial=-1;version=0;title="";motion=null;recordedPuffs=null;trailStart=-1/0;get start(){let e=this.levels.filter(({trial:t})=>t===this.trial);return Math.min(this.motion?.head.start??1/0,e[0]?.level.start??0)}get end(){let e=this.levels.filter(({trial:t})=>t===this.trial);return Math.max(this.motion?.end??0,...e.map(({level:t})=>t.end))}async select(e){if(e===this.trial)return;let t=this.pack.head.trials?.[e];if(this.trial=e,this.motion=this.recordedPuffs=null,this.trailStart=-1/0,this.curves=[],!t)return;this.title=t.title,this.curves=t.curves.map(({name:i,unit:n,times:o,values:a,names:l,is_share:c})=>({name:i,unit:n,names:l,isFraction:c,times:Array.from(this.pack.numbers(o),h=>h/N0),values:Array.from(this.pack.numbers(a),h=>Number.isNaN(h)?null:h)})),t.motion&&(this.motion=await Ma(this.pack.numbers(t.motion)));let r=this.pack.head.particles?.sediment;r&&this.motion?.births.length&&(this.recordedPuffs=new js(r,this.motion.births,i=>this.snapshot(i).drift().velocity))}snapshot(e){let t=this.pack.head.trials?.[this.trial]?.poses;return new fs(e,this.motion?.head??null,this.motion?.row(e)??null,t)}speed(e,t){let r=this.motion,i=r?.head.bodies.indexOf(e)??-1;if(!r||i<0)return null;let n=r.head.start+(r.head.n-1)/r.head.rate,o=Math.min(n,Math.max(t,r.head.start+Os)),a=[o-Os,o].map(l=>[...r.row(l).slice(7*i,7*i+3)]);return Bo(a[0],a[1],Os)}markers(e){let[t,r]=[this.motion,this.motion?.head.markers];if(!t||!r)return[];let i=t.rowIndex(e),n=new Map;for(let o of r.changes){if(o[0]>i)break;o.length>2?n.set(o[1],o):n.delete(o[1])}return[...n.values()].map(([,o,a,l,c])=>{let h=nt(c),u=r.shapes[a].map(m=>m.map(p=>Re(h,p)));return{name:o,at:c.slice(0,3),colour:l,lines:u}})}sand(e,t){let r=this.motion?.rowIndex(t)??-1;return this.motion?.removals.filter(i=>i.heap===e&&i.row<=r)??[]}puffs(e){return this.recordedPuffs?.puffsAt(e)??null}trail(e,t){let r=this.motion,i=r?.head.bodies.indexOf(e)??-1;if(!r||i<0)return[];let{rate:n,start:o,n:a}=r.head,l=Math.min(a-1,Math.floor((t-o)*n)),c=[],h=Math.max(0,Math.ceil((this.trailStart-o)*n));for(let u=h;u<=l;u+=Math.max(1,Math.round(n/Vo))){let m=u*r.columns+7*i;c.push(Array.from(r.rows.subarray(m,m+3)))}return c}clearTrails(e){this.trailStart=e}};function Bo(s,e,t){let r=Math.hypot(...e.map((i,n)=>i-s[n]))/t;return t>0&&r<C0?r:null}var sn=class{constructor(e){this.head=e;this.title=e.title}head;isLive=!0;start=0;curves=[];levels=[];trial=0;end=0;title;version=0;currentMarkers=[];heights=new Map;currentPuffs=null;row=null;recentRows=[];trails=[];push(e,t){let r=this.trails.at(-1);for(e===this.end&&(this.version+=1),e<this.end&&(this.trails.length=this.recentRows.length=0),(!r||e-r.time>=1/Vo)&&this.trails.push({time:e,row:t}),this.trails.length>2e4&&this.trails.splice(0,1e4),this.recentRows.push({time:e,row:t});this.recentRows.length>2&&this.recentRows[1].time<=e-Os;)this.recentRows.shift();this.row=t,this.end=e}speed(e){let t=this.head.motion?.bodies.indexOf(e)??-1,[r,i]=[this.recentRows[0],this.recentRows.at(-1)];if(t<0||!r||!i||i.time<=r.time)return null;let n=[r,i].map(({row:o})=>[0,1,2].map(a=>o[7*t+a]));return Bo(n[0],n[1],i.time-r.time)}sample(e,t,r,i){let n=this.curves.find(o=>o.name===e);n||(n={name:e,unit:t,times:[],values:[]},this.curves.push(n)),n.times.push(r),n.values.push(i)}setLevels(e){this.levels.splice(0,this.levels.length,...e.map(t=>({trial:0,level:t}))),this.version+=1}async select(){}snapshot(){return new fs(this.end,this.head.motion??null,this.row)}setMarkers(e){this.currentMarkers=e,this.version+=1}markers(){return this.currentMarkers}setSand(e,t){this.heights.set(e,t),this.version+=1}sand(e){return this.heights.get(e)??[]}setPuffs([e,...t]){let r=Array.from({length:t.length/Qr},(i,n)=>t.slice(Qr*n,Qr*(n+1)));this.currentPuffs={time:e,puffs:r},this.version+=1}puffs(){return this.currentPuffs}trail(e){let t=this.head.motion?.bodies.indexOf(e)??-1;return t<0?[]:this.trails.map(({row:r})=>[0,1,2].map(i=>r[7*t+i]))}clearTrails(){this.trails.length=0}};var O0=.5,nn=class{constructor(e){this.pack=e}pack;cast(e,t,r,i){let n=1;for(let o of this.pack.head.bodies){if(!o.visuals.length||i(o))continue;let a=r(o.name);for(let l of o.visuals){if(l.hidden||l.opacity<O0)continue;let c=U0(Ie(a,Se(l.matrix)));if(!c)continue;let[h,u]=[Re(c,e),Re(c,t)];n=Math.min(n,this.hitMesh(l,h,u,n))}}return n}hitMesh(e,t,r,i){let n=this.pack.head.meshes[e.mesh],o=Me(r,t,-1),a=le(o,o);for(let l of n.pieces){let c=Me([l[2],l[3],l[4]],t,-1),h=a>0?Math.min(i,Math.max(0,le(c,o)/a)):0,u=Me(c,o,-h);if(le(u,u)>l[5]*l[5])continue;let m=this.pack.numbers(n.positions),p=this.pack.numbers(n.triangles);for(let y=l[0];y<l[0]+l[1];y+=3)i=Math.min(i,D0(m,p,y,t,o))}return i}};function D0(s,e,t,r,i){let[n,o,a]=[3*e[t],3*e[t+1],3*e[t+2]],[l,c,h]=[s[n],s[n+1],s[n+2]],[u,m,p]=[s[o]-l,s[o+1]-c,s[o+2]-h],[y,_,w]=[s[a]-l,s[a+1]-c,s[a+2]-h],[E,x,M]=[i[0],i[1],i[2]],[S,F,L]=[x*w-M*_,M*y-E*w,E*_-x*y],C=u*S+m*F+p*L;if(Math.abs(C)<1e-14)return 1/0;let[U,V,N]=[r[0]-l,r[1]-c,r[2]-h],R=(U*S+V*F+N*L)/C;if(R<0||R>1)return 1/0;let[H,z,j]=[V*p-N*m,N*u-U*p,U*m-V*u],W=(E*H+x*z+M*j)/C;if(W<0||R+W>1)return 1/0;let Z=(y*H+_*z+w*j)/C;return Z>=0?Z:1/0}function U0(s){let e=[0,1,2].map(o=>[s[4*o],s[4*o+1],s[4*o+2]]),t=[it(e[1],e[2]),it(e[2],e[0]),it(e[0],e[1])],r=le(e[0],t[0]);if(Math.abs(r)<1e-18)return null;let i=[0,1,2].map(o=>t.map(a=>a[o]/r)),n=i.map(o=>-le(o,[s[3],s[7],s[11]]));return Se([...i.flatMap((o,a)=>[...o,n[a]]),0,0,0,1])}function Cu(s){let{player:e,picture:t}=s;Object.assign(window,{uwsim:{page:s,seek:r=>s.seek(r),go:r=>s.go(r),time:()=>s.time,level:()=>_r(e,s.time),curves:()=>Object.fromEntries(e.curves.map(r=>[r.name,po(r,s.time)])),body:r=>Array.from(t.models.body(r)),markers:()=>e.markers(s.time),sand:r=>Array.from(t.models.heights(r)),puffs:()=>e.puffs(s.time)?.puffs??[],particles:r=>{let{cameras:i,particles:n,water:o}=s.pack.head,a=i.find(h=>h.name===r),l=e.snapshot(s.time);t.models.place(l.poses);let c=t.models.worldFromMount(a);return Array.from(Di(n,l.drift(),c,a,o.surface_height))},image:(r,i={})=>{let n=s.pack.head.cameras.find(c=>c.name===r),o=e.snapshot(s.time);t.models.place(o.poses);let a=t.models.worldFromMount(n),l={grey:n.grey,water:i};return Fu(t.image(n,a,e,o,s.switches,l))},external:(r,i)=>{let[n]=s.pack.head.cameras,o={isExternal:!0,isClear:i},a=e.snapshot(s.time);return Fu(t.image(n,Se(r),e,a,s.switches,o))}}})}function Fu(s){let e="";for(let t=0;t<s.length;t+=8192)e+=String.fromCharCode(...s.subarray(t,t+8192));return btoa(e)}var V0="This browser does not support WebGL 2: the page shows no 3-D view, only the results (levels and curves).",B0="This browser cannot draw into floating-point textures: the page shows the fog of the scene, not its physical water.";async function z0(){let s=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.theme=s?"dark":"light";let e=G("message");e.textContent="Loading…";try{let t=document.getElementById("pack"),r=ku(G("image")),n=t?null:await ic(r===null),o=n?n.pack:await bs(Sa(t.textContent??"")),a=await tn.make(r,o),l=n?new sn(o.head):new rn(o),c=new nn(o),h=new Ei(o,l,a,new xi(o.head,a.models,c),n,c);h.note=r||n?"":V0,a.lacksFloats&&(h.note=B0),e.textContent=h.note,n?.begin(h,l);let u=Number(new URLSearchParams(location.hash.slice(1)).get("level")??0);n||(await h.select(l.levels[u]?.trial??0),h.seek(l.levels[u]?l.levels[u].level.start:l.start)),Cu(h)}catch(t){throw e.textContent=t instanceof Error?t.message:String(t),t}}z0();})();
